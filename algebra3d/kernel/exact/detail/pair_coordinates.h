#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "algebra3d/kernel/exact/detail/bounded_pair.h"
#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/detail/length_estimate.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d::detail {

// Determinants of points that are not triples of doubles, by pairs of doubles: a hundred bits of each coordinate, where
// rounded points have 53. Where facets nearly coincide their points are some roundings apart, so nearly all signs that
// rounded points leave open are decided, at a fifth of the cost of integers.

/// True if pairs stand for the coordinates of all points: none is so small or large that their determinants over- or
/// underflow.
inline bool have_pairs(std::span<const PointRef* const> points) {
  return std::ranges::all_of(points, [](const PointRef* point) {
    const Vec3& p = point->approx;
    return LengthEstimate::is_in_range(p.x) && LengthEstimate::is_in_range(p.y) && LengthEstimate::is_in_range(p.z);
  });
}

/// A coordinate of a point for which `have_pairs` holds: without error if it is a double.
inline BoundedPair pair_of(const PointRef& point, std::size_t axis) {
  const double rounded = point.approx[axis];
  if (point.is_double() || point.exact->beyond(axis) == 0) return {rounded, 0, 0};
  const double rest = point.exact->rest(axis, rounded);
  // Besides its relative error the rest has one by underflow. The last number is above that, and so large that no
  // product of three differences underflows below its error.
  return {rounded, rest, 0x1p-50 * std::abs(rest) + 0x1p-260};
}

/// Sign of the number, or kUndecided.
inline int sign_of(const BoundedPair& number) {
  if (number.is_zero()) return 0;
  return number.size() > 1.0625 * number.error ? (number.value > 0 ? 1 : -1) : kUndecided;
}

}  // namespace algebra3d::detail
