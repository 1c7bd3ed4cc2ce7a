#include "algebra3d/arrangement/boxes.h"

namespace algebra3d::arrangement {

Box3 box_of_triangle(const TriangleRef& corners) {
  Box3 box;
  for (const PointRef& corner : corners)
    if (corner.is_double())
      box.extend(corner.approx);
    else
      box.extend(box_of(corner));
  return box;
}

Box3 box_of_mesh(const TriangleMesh& mesh) {
  Box3 box;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) box.extend(box_of_triangle(mesh.corners(FaceId(f))));
  return box;
}

}  // namespace algebra3d::arrangement
