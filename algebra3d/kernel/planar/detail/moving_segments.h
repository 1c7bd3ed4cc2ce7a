#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// The exact real number `whole + factor * sqrt(radicand)`; the radicand is not negative.
struct Surd {
  Rational whole;
  Rational factor = 0;
  Rational radicand = 0;

  int sign() const;  ///< -1, 0 or 1
  double approx() const;
};

/// A time 0 < s < 1 of a motion, or the time right after it.
struct Moment {
  Surd s;
  bool is_right_after = false;  ///< every s in some (this s, this s + e)
};

/// The polynomial a s^2 + b s + c; a and b may be 0.
struct Quadratic {
  Rational a, b, c;

  bool is_zero() const { return a.sign() == 0 && b.sign() == 0 && c.sign() == 0; }
  Surd at(const Surd& s) const;
  /// Its sign; right after a moment that of the first derivative that is not 0.
  int sign_at(const Moment& moment) const;
  /// Appends the roots 0 < s < 1, a double root once; none if the polynomial is 0.
  void append_roots(std::vector<Surd>& roots) const;

  friend Quadratic operator+(const Quadratic& p, const Quadratic& q);
  friend Quadratic operator-(const Quadratic& p, const Quadratic& q);
};

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
