#include "algebra3d/base/box3.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace algebra3d {
namespace {

Vec3 gap_between(const Box3& a, const Box3& b) {
  Vec3 gap;
  for (std::size_t axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({0.0, a.min[axis] - b.max[axis], b.min[axis] - a.max[axis]});
  return gap;
}

}  // namespace

Box3 Box3::around(std::span<const Vec3> points) {
  Box3 box;
  for (const Vec3& point : points) box.extend(point);
  return box;
}

void Box3::extend(const Vec3& point) {
  extend(Box3::of(point));
}

void Box3::extend(const Box3& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis] = std::min(min[axis], other.min[axis]);
    max[axis] = std::max(max[axis], other.max[axis]);
  }
}

Box3 unite(const Box3& a, const Box3& b) {
  Box3 result = a;
  result.extend(b);
  return result;
}

Box3 intersect(const Box3& a, const Box3& b) {
  Box3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = std::max(a.min[axis], b.min[axis]);
    result.max[axis] = std::min(a.max[axis], b.max[axis]);
  }
  return result.is_empty() ? Box3{} : result;
}

std::ostream& operator<<(std::ostream& out, const Box3& box) {
  return out << '(' << box.min << ' ' << box.max << ')';
}

double squared_distance(const Box3& a, const Box3& b) {
  const Vec3 gap = gap_between(a, b);
  return dot(gap, gap);
}

double distance(const Box3& a, const Box3& b) {
  return length(gap_between(a, b));
}

// Half of the smallest side that there is would be 0.
double length_unit(const Box3& box) {
  constexpr int kLowest = -1070, kHighest = 1020;
  double half = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) half = std::max(half, 0.5 * box.max[axis] - 0.5 * box.min[axis]);
  int exponent = kLowest;
  if (half > 0) std::frexp(half, &exponent);
  return std::ldexp(1, std::clamp(exponent, kLowest, kHighest));
}

}  // namespace algebra3d
