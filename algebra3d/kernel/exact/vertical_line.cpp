#include "algebra3d/kernel/exact/vertical_line.h"

#include <compare>

namespace algebra3d {

namespace {

int as_int(std::strong_ordering order) {
  return std::is_lt(order) ? -1 : std::is_gt(order) ? 1 : 0;
}

// Side of edge ab on which p moved by (e, e^2) lies in projection. The determinant (b-a) x (p-a) grows by
// -e (b.y - a.y) + e^2 (b.x - a.x); 0 is left only if a and b have the same projection.
int side_of_moved_point(const PointRef& a, const PointRef& b, const PointRef& p) {
  if (const int side = orient2d(Projection::xy, a, b, p); side != 0) return side;
  if (const int down = as_int(compare(1, a, b)); down != 0) return down;
  return as_int(compare(0, b, a));
}

}  // namespace

LineCrossing cross_vertical_line(PointRef p, const TriangleRef& triangle) {
  const auto& [a, b, c] = triangle;
  const int sign = side_of_moved_point(a, b, p);
  if (sign == 0 || side_of_moved_point(b, c, p) != sign || side_of_moved_point(c, a, p) != sign) return {};
  // The three determinants sum to the projected area, which therefore has their sign.
  return {sign, sign * orient3d(a, b, c, p)};
}

}  // namespace algebra3d
