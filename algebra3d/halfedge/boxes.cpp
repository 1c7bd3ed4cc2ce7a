#include "algebra3d/halfedge/boxes.h"

namespace algebra3d {

Box3 box_of_triangle(const TriangleRef& corners) {
  Box3 box;
  for (const PointRef& corner : corners) box.extend(box_of(corner));
  return box;
}

}  // namespace algebra3d
