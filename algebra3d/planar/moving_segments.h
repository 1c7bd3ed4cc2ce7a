#pragma once

#include <cstdint>
#include <optional>

#include "algebra3d/exact/point.h"
#include "algebra3d/planar/quadratic.h"

namespace algebra3d {

/// A point of the plane that moves evenly from `start` at s = 0 to `end` at s = 1.
struct MovingPoint {
  PointRef start;
  PointRef end;
};

struct MovingSegment {
  MovingPoint from;
  MovingPoint to;
};

/// What two segments that are no points have in common.
enum class Meeting : std::uint8_t { none, touching, crossing, overlap };

/// What happens, and when.
struct Clash {
  Meeting meeting = Meeting::none;
  Moment moment;
};

// All of these look at the times 0 < s < 1, and decide exactly.

/// The time at which the segment has no length; it is the only one, or all are.
std::optional<Moment> vanishing(const MovingSegment& segment);

/// The first time at which two segments cross or overlap, or, if `may_touch` is false, have any point in common.
/// Requires that neither vanishes. Of roots closer than rounding tells apart either may count as the first.
std::optional<Clash> first_clash(const MovingSegment& ab, const MovingSegment& cd, bool may_touch);
/// The first time at which the segments from `corner` to `a` and to `b` lie on each other. Requires that neither
/// vanishes.
std::optional<Moment> first_fold(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b);

// Quick answers by floating-point intervals: true is certain, false says nothing.

/// The segments never have a point in common.
bool surely_apart(const MovingSegment& ab, const MovingSegment& cd);
/// The segments from `corner` to `a` and to `b` never lie on each other.
bool surely_unfolded(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b);

}  // namespace algebra3d
