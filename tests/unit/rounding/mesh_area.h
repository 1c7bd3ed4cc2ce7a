#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d::solids {

/// The sum of the areas of all triangles; rounded.
inline double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    area += length(cross(t[1].approx - t[0].approx, t[2].approx - t[0].approx)) / 2;
  }
  return area;
}

}  // namespace algebra3d::solids
