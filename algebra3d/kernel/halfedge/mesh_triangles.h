#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The triangles of a mesh in their order, as index triples. Cost: linear, 12 bytes each.
inline std::vector<TriangleMesh::Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Triangle> triangles(mesh.face_count());
  for (std::size_t f = 0; f < triangles.size(); ++f) triangles[f] = mesh.triangle(FaceId(f));
  return triangles;
}

}  // namespace algebra3d
