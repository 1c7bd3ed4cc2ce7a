#pragma once

#include "algebra3d/kernel/distance/detail/simplex.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d::distances {

/// A point of each of two simplices, and the square of their distance.
struct ExactClosest {
  RationalVec3 first, second;
  Rational squared_distance;
};

/// The features whose insides hold the points that are nearest to each other, as far as rounded numbers decide it; 0 if
/// nothing is known.
struct ClosestFeatures {
  Feature first = 0, second = 0;
};

/// The points of two simplices that are nearest to each other; a common point if they meet. If several pairs of points
/// are equally near, one of them. Exact: the points of a pair of features are computed with rationals, and taken if
/// each lies in its simplex and both simplices lie beyond the slab between them. Cost: some dozens of rational
/// operations if `likely` is right, else those of up to 49 pairs of features.
ExactClosest exact_closest(const Simplex& a, const Simplex& b, const ClosestFeatures& likely = {});

}  // namespace algebra3d::distances
