#pragma once

#include <CGAL/Surface_mesh.h>

#include "shapes.h"

namespace bench {

template <typename Kernel>
using CgalMesh = CGAL::Surface_mesh<typename Kernel::Point_3>;

template <typename Kernel>
CgalMesh<Kernel> cgal_mesh_of(const Shape& shape) {
  CgalMesh<Kernel> mesh;
  for (const Vec3& p : shape.points) mesh.add_vertex({p.x, p.y, p.z});
  using V = typename CgalMesh<Kernel>::Vertex_index;
  for (const auto& t : shape.triangles) mesh.add_face(V(t[0]), V(t[1]), V(t[2]));
  return mesh;
}

}  // namespace bench
