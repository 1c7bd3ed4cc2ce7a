#include "algebra3d/kernel/exact/vertical_line.h"

#include <compare>
#include <cstddef>

#include "algebra3d/kernel/exact/axis_line.h"

namespace algebra3d {

namespace {

int as_int(std::strong_ordering order) {
  return std::is_lt(order) ? -1 : std::is_gt(order) ? 1 : 0;
}

// Side of edge ab on which p, moved by (e, e^2), lies in projection. With i and j the axes that the projection keeps,
// the determinant (b-a) x (p-a) grows by -e (b_j - a_j) + e^2 (b_i - a_i); 0 is left only if a and b have the same
// projection.
int side_of_moved_point(Projection plane, const PointRef& a, const PointRef& b, const PointRef& p) {
  if (const int side = orient2d(plane, a, b, p); side != 0) return side;
  if (const int down = as_int(compare(second_axis(plane), a, b)); down != 0) return down;
  return as_int(compare(first_axis(plane), b, a));
}

inline LineCrossing cross_line(Projection plane, const PointRef& p, const TriangleRef& triangle) {
  const auto& [a, b, c] = triangle;
  const int sign = side_of_moved_point(plane, a, b, p);
  if (sign == 0 || side_of_moved_point(plane, b, c, p) != sign || side_of_moved_point(plane, c, a, p) != sign)
    return {};
  // The three determinants sum to the projected area, which therefore has their sign. A cyclic exchange of the axes
  // leaves orient3d as it is.
  return {sign, sign * orient3d(a, b, c, p)};
}

}  // namespace

LineCrossing cross_vertical_line(PointRef p, const TriangleRef& triangle) {
  return cross_line(Projection::xy, p, triangle);
}

LineCrossing cross_axis_line(std::size_t axis, PointRef p, const TriangleRef& triangle) {
  return cross_line(static_cast<Projection>(axis), p, triangle);
}

}  // namespace algebra3d
