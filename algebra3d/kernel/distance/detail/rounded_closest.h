#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/distance/detail/exact_closest.h"
#include "algebra3d/kernel/distance/detail/simplex.h"

namespace algebra3d::distances {

/// Bounds of the distance of two simplices, and the features that seem to hold the nearest points.
struct DistanceBounds {
  double lower = 0, upper = 0;
  ClosestFeatures features;
  Vec3 direction;  ///< from the nearest points of the first to those of the second, of length 1; 0 if they seem to meet
};

/// Distances of simplices in rounded arithmetic, with guaranteed bounds. Computes in units of a power of two that is
/// chosen once for all simplices, so that squares of coordinates neither overflow nor lose all their bits.
class RoundedDistances {
 public:
  /// For simplices within the box.
  explicit RoundedDistances(const Box3& box);

  /// The bounds, in coordinate units; the upper one is infinite beyond the range of doubles. The nearest points that
  /// rounded numbers find give the upper bound, the slab between the planes through them the lower one. Both are within
  /// some 200 roundings of the extent of both simplices, and of the largest coordinate if coordinates are exact. Cost:
  /// some hundred nanoseconds. Source: [ericson2005], section 5.1, for the nearest points of features.
  DistanceBounds bounds(const Simplex& a, const Simplex& b) const;

 private:
  double half_scale_;         // from halved coordinates to units
  double smallest_rounding_;  // of coordinates in the subnormal range, in units
};

}  // namespace algebra3d::distances
