#include <array>
#include <cstddef>

#include "algebra3d/kernel/exact/interval.h"
#include "algebra3d/kernel/planar/detail/moving_segments.h"

// A number that changes as a polynomial of degree 1 or 2 keeps its sign over a span of time if its Bernstein
// coefficients there have that sign. At the ends of the unit, which are not looked at, a coefficient may be 0; there
// the intervals are the points themselves, so that a coefficient 0 is found to be 0.

namespace algebra3d {
namespace {

using detail::Interval;
using detail::kUndecided;

constexpr int kHalvings = 6;

/// A part of the unit: from <= s <= to, without 0 and 1.
struct TimeSlab {
  double from = 0;
  double to = 1;
};

struct IntervalVector {
  Interval x, y;
};
IntervalVector operator-(const IntervalVector& a, const IntervalVector& b) {
  return {a.x - b.x, a.y - b.y};
}
Interval cross(const IntervalVector& a, const IntervalVector& b) {
  return a.x * b.y - a.y * b.x;
}
Interval dot(const IntervalVector& a, const IntervalVector& b) {
  return a.x * b.x + a.y * b.y;
}

/// A vector at the two ends of a span of time.
struct VectorSpan {
  IntervalVector first, last;
};
VectorSpan operator-(const VectorSpan& a, const VectorSpan& b) {
  return {a.first - b.first, a.last - b.last};
}

Interval coordinate_at(const MovingPoint& point, std::size_t axis, double s) {
  const Interval start = detail::interval_of(point.start, axis);
  if (s == 0) return start;
  const Interval end = detail::interval_of(point.end, axis);
  if (s == 1) return end;
  return start + (end - start) * Interval{s, 0};
}
VectorSpan positions(const MovingPoint& point, const TimeSlab& slab) {
  return {{coordinate_at(point, 0, slab.from), coordinate_at(point, 1, slab.from)},
          {coordinate_at(point, 0, slab.to), coordinate_at(point, 1, slab.to)}};
}

/// The sign that a polynomial with these coefficients has at all times of the slab, or kUndecided.
template <std::size_t n>
int lasting_sign(const std::array<Interval, n>& coefficients, const TimeSlab& slab) {
  int result = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const int sign = coefficients[i].sign();
    const bool may_be_zero = (i > 0 || slab.from == 0) && (i + 1 < n || slab.to == 1);
    if (sign == kUndecided || (sign == 0 && !may_be_zero) || sign * result < 0) return kUndecided;
    if (sign != 0) result = sign;
  }
  return result == 0 ? kUndecided : result;
}
int lasting_cross(const VectorSpan& a, const VectorSpan& b, const TimeSlab& slab) {
  return lasting_sign<3>(
      {cross(a.first, b.first), cross(a.first, b.last) + cross(a.last, b.first), cross(a.last, b.last)}, slab);
}
int lasting_dot(const VectorSpan& a, const VectorSpan& b, const TimeSlab& slab) {
  return lasting_sign<3>({dot(a.first, b.first), dot(a.first, b.last) + dot(a.last, b.first), dot(a.last, b.last)},
                         slab);
}

bool is_common_sign(int sign, int other) {
  return sign != kUndecided && sign == other;
}

/// The line through p, in direction v, has both of these points on one side.
bool is_beside(const VectorSpan& p, const VectorSpan& v, const VectorSpan& a, const VectorSpan& b,
               const TimeSlab& slab) {
  const int side = lasting_cross(v, a - p, slab);
  return side != kUndecided && is_common_sign(side, lasting_cross(v, b - p, slab));
}

/// a and b lie on one side of c and d along an axis.
bool is_apart_along(Interval IntervalVector::*axis, const std::array<VectorSpan, 4>& points, const TimeSlab& slab) {
  const auto order = [&](std::size_t i, std::size_t j) {
    return lasting_sign<2>({points[j].first.*axis - points[i].first.*axis, points[j].last.*axis - points[i].last.*axis},
                           slab);
  };
  const int sign = order(0, 2);
  return sign != kUndecided && sign == order(0, 3) && sign == order(1, 2) && sign == order(1, 3);
}

bool is_apart(const MovingSegment& ab, const MovingSegment& cd, const TimeSlab& slab) {
  const std::array points = {positions(ab.from, slab), positions(ab.to, slab), positions(cd.from, slab),
                             positions(cd.to, slab)};
  const auto& [a, b, c, d] = points;
  return is_apart_along(&IntervalVector::x, points, slab) || is_apart_along(&IntervalVector::y, points, slab) ||
         is_beside(a, b - a, c, d, slab) || is_beside(c, d - c, a, b, slab);
}

bool is_unfolded(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b, const TimeSlab& slab) {
  const VectorSpan middle = positions(corner, slab);
  const VectorSpan to_a = positions(a, slab) - middle;
  const VectorSpan to_b = positions(b, slab) - middle;
  return lasting_cross(to_a, to_b, slab) != kUndecided || lasting_dot(to_a, to_b, slab) == -1;
}

/// Holds in the slab, or in parts that make it up. The recursion is as deep as there are halvings.
template <typename Holds>
bool holds_in_parts(const Holds& holds, const TimeSlab& slab = {}, int halvings = kHalvings) {
  if (holds(slab)) return true;
  if (halvings == 0) return false;
  const double middle = (slab.from + slab.to) / 2;
  return holds_in_parts(holds, {slab.from, middle}, halvings - 1) &&
         holds_in_parts(holds, {middle, slab.to}, halvings - 1);
}

}  // namespace

bool surely_apart(const MovingSegment& ab, const MovingSegment& cd) {
  return holds_in_parts([&](const TimeSlab& part) { return is_apart(ab, cd, part); });
}

bool surely_unfolded(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b) {
  return holds_in_parts([&](const TimeSlab& part) { return is_unfolded(a, corner, b, part); });
}

}  // namespace algebra3d
