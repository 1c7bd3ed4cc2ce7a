#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// A ball with an exact centre.
struct ExactBall {
  RationalVec3 centre;
  Rational squared_radius;
};

/// The smallest ball that contains all points; nothing for the empty set. Exact. Errors: interrupted. Cost: some ten to
/// twenty passes over the points. Source: [gaertner1999] for the order of the pivots: the farthest point joins those
/// that hold the ball; which of these at most five hold the next one is found by trying all subsets, exactly.
Result<std::optional<ExactBall>> smallest_enclosing_ball(const PointArray& points, const Monitor& monitor = {});

/// A ball of doubles.
struct RoundedBall {
  Vec3 centre;
  double radius = 0;  ///< infinite beyond the range of doubles
};

/// The ball around the rounded centre of `ball` with the smallest double as radius that contains all points. So the
/// radius is larger than that of `ball` by the distance between the centres, and a rounding, at most.
RoundedBall rounded_ball(const ExactBall& ball, const PointArray& points);

}  // namespace algebra3d
