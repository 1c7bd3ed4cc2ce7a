#pragma once

#include <cstdint>
#include <optional>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/planar/detail/quadratic.h"

namespace algebra3d {

/// A point of the plane that moves linearly from `start` at s = 0 to `end` at s = 1.
struct MovingPoint {
  PointRef start;
  PointRef end;
};

struct MovingSegment {
  MovingPoint from;
  MovingPoint to;
};

/// The kind of intersection of two segments of positive length.
enum class SegmentIntersection : std::uint8_t { none, touching, crossing, overlap };

/// An intersection of moving segments and its time.
struct SegmentClash {
  SegmentIntersection intersection = SegmentIntersection::none;
  Moment moment;
};

// The following functions consider the times 0 < s < 1 and decide exactly.

/// The time at which the segment has length 0: the only one, or any if it always has length 0.
std::optional<Moment> vanishing(const MovingSegment& segment);

/// The first time at which two segments cross or overlap, or, if `may_touch` is false, have any point in common.
/// Requires that neither vanishes. If two roots are equal after rounding, either may count as the first.
std::optional<SegmentClash> first_clash(const MovingSegment& ab, const MovingSegment& cd, bool may_touch);
/// The first time at which the segments from `corner` to `a` and to `b` overlap. Requires that neither vanishes.
std::optional<Moment> first_fold(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b);

// Filters with floating-point intervals: true is proved, false is undecided.

/// True if the segments never intersect.
bool surely_apart(const MovingSegment& ab, const MovingSegment& cd);
/// True if the segments from `corner` to `a` and to `b` never overlap.
bool surely_unfolded(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b);

}  // namespace algebra3d
