#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/values/spatial_relations/relation.h"

namespace algebra3d {

// Distances of two sets in space: the smallest of the distances of a point of one and a point of the other, so 0 if
// they meet. The inside of a solid belongs to it. How it is computed: docs/spatial-relations.md. Errors: interrupted.

/// A point of each of two sets, nearest to each other, and the square of their distance.
struct NearestPoints {
  ExactPoint first, second;
  Rational squared_distance;
};

/// The nearest points, a common point if the sets meet; nothing if a set is empty. If several pairs are equally near,
/// always the same one of them. Exact. Cost: that of the pairs of boxes which are nearer to each other than the sets.
Result<std::optional<NearestPoints>> nearest_points(const SpatialSet& a, const SpatialSet& b,
                                                    const Monitor& monitor = {});

/// The square of the distance of the sets; nothing if a set is empty. Exact. Cost: as nearest_points, and that of
/// do_meet if they meet.
Result<std::optional<Rational>> squared_distance_of(const SpatialSet& a, const SpatialSet& b,
                                                    const Monitor& monitor = {});

/// Bounds of the distance of the sets, both 0 if they meet; nothing if a set is empty, or if they are certainly farther
/// apart than `reach`. Cost: that of do_meet, and of a search in rounded arithmetic.
Result<std::optional<DistanceRange>> distance_range_of(const SpatialSet& a, const SpatialSet& b, double reach,
                                                       const Monitor& monitor = {});

/// True if the distance of the sets is at most `distance`; false if a set is empty or `distance` negative. Exact. Cost:
/// as nearest_points, and less if the sets are clearly nearer or farther.
Result<bool> are_within(const SpatialSet& a, const SpatialSet& b, const Rational& distance,
                        const Monitor& monitor = {});

/// The answer of `are_within` by the boxes of two sets alone: false if they are farther apart than `distance`, true if
/// any two points of them are within it, else nothing. Boxes that are not empty, and as small as doubles allow or
/// larger.
std::optional<bool> are_within_by_boxes(const Box3& a, const Box3& b, double distance);

}  // namespace algebra3d
