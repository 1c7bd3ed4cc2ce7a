#include "algebra3d/kernel/repair/detail/measure_frame.h"

#include <algorithm>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/soup/rounding_noise.h"

namespace algebra3d {

MeasureFrame::MeasureFrame(const TriangleMesh& given, const TriangleMesh& solid, double moved, const Monitor& monitor)
    : given_(given), solid_(solid), monitor_(monitor) {
  const double largest = std::max(largest_coordinate(given), largest_coordinate(solid));
  scale_ = BinaryScale(largest);
  Box3 box;
  for (const Vec3& p : given.points().approx()) box.extend(scale_.scaled(p));
  tolerance_ = std::max(scale_.scaled(moved), RoundingNoise(given.points().approx()).within(box));
}

}  // namespace algebra3d
