#include <algorithm>
#include <cmath>

#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/expansion.h"

// The image of a point of doubles as a sum of two doubles with a bound on the error, and Ziv's test on it: if the ends
// of the interval of error round to the same double, so does the exact value [ziv1991]. A product of doubles is kept
// whole as two [dekker1971], so the error is that of the small terms alone, about 2^-100 of the result. It is zero
// where the small terms are: mirrors at coordinate planes, quarter turns, scalings by powers of two, translations by
// short vectors. The bounds hold in rounding to nearest, without overflow or underflow; `is_safe` of expansion.h sees
// to that.

namespace algebra3d {

namespace {

using detail::Rounded;

constexpr double kSmallestError = 0x1p-500;  // keeps products of error and coordinate away from underflow
constexpr double kLargestShift = 0x1p600;

/// The exact image is high + low up to `error`, and high is high + low rounded.
struct Estimate {
  double high, low, error;

  bool decides_rounding() const {
    if (error == 0) return true;
    // Wider by the rounding of low +- margin.
    const double margin = error * (1 + 0x1p-40) + std::abs(low) * 0x1p-50;
    return high + (low + margin) == high && high + (low - margin) == high;
  }
};

struct Coordinate {
  double value;
  Rounded halves;

  explicit Coordinate(double number) : value(number), halves(detail::split(number)) {}
};

struct Coordinates {
  Coordinate x, y, z;
};

}  // namespace

/// The filter for one coordinate of the image.
struct RowFilter {
  using Split = AffineMap::Split;

  const AffineMap::SplitRow& row;
  const Coordinates& point;

  static Rounded product(const Split& entry, const Coordinate& c) {
    const double value = entry.high * c.value;
    const double missing = ((value - entry.high_head * c.halves.value) - entry.high_tail * c.halves.value) -
                           entry.high_head * c.halves.rest;
    return {value, entry.high_tail * c.halves.rest - missing};
  }

  /// The error of the image that the entries' own errors cause, rounded upward by the callers' factors.
  double entry_error() const {
    const auto& [a, b, c, d] = row.entries;
    return a.error * std::abs(point.x.value) + b.error * std::abs(point.y.value) + c.error * std::abs(point.z.value) +
           d.error;
  }

  /// The ten small terms are summed as they come: with u = 2^-53 their sum and the three rounded products among them
  /// are off by less than 10u of the sum of their magnitudes, to first order; 2^-48 = 32u covers that and its own
  /// rounding.
  Estimate quick() const {
    const auto& [a, b, c, d] = row.entries;
    const Rounded p = product(a, point.x), q = product(b, point.y), r = product(c, point.z);
    const Rounded s = detail::two_sum(p.value, q.value), t = detail::two_sum(r.value, d.high);
    const Rounded sum = detail::two_sum(s.value, t.value);
    const double i = a.low * point.x.value, j = b.low * point.y.value, k = c.low * point.z.value;
    const double small = ((p.rest + q.rest) + (r.rest + s.rest)) + ((t.rest + sum.rest) + ((i + j) + (k + d.low)));
    const double size =
        ((std::abs(p.rest) + std::abs(q.rest)) + (std::abs(r.rest) + std::abs(s.rest))) +
        ((std::abs(t.rest) + std::abs(sum.rest)) + ((std::abs(i) + std::abs(j)) + (std::abs(k) + std::abs(d.low))));
    const Rounded result = detail::two_sum(sum.value, small);
    return {result.value, result.rest, size * 0x1p-48 + entry_error() * (1 + 0x1p-40)};
  }

  /// Like `quick`, but keeps the error of each rounding, so that the error is zero if nothing was lost. Decides ties of
  /// maps with entries of at most 106 bits.
  Estimate thorough() const {
    const auto& [a, b, c, d] = row.entries;
    const Rounded p = product(a, point.x), q = product(b, point.y), r = product(c, point.z);
    const Rounded s = detail::two_sum(p.value, q.value), t = detail::two_sum(r.value, d.high);
    const Rounded sum = detail::two_sum(s.value, t.value);
    const Rounded i = detail::two_product(a.low, point.x.value, point.x.halves);
    const Rounded j = detail::two_product(b.low, point.y.value, point.y.halves);
    const Rounded k = detail::two_product(c.low, point.z.value, point.z.halves);
    Rounded small{sum.rest, 0};
    double lost = std::abs(i.rest) + std::abs(j.rest) + std::abs(k.rest);
    for (const double term : {s.rest, t.rest, p.rest, q.rest, r.rest, i.value, j.value, k.value, d.low}) {
      small = detail::two_sum(small.value, term);
      lost += std::abs(small.rest);
    }
    const Rounded result = detail::two_sum(sum.value, small.value);
    return {result.value, result.rest, (lost + entry_error()) * (1 + 0x1p-40)};
  }
};

AffineMap::SplitRow AffineMap::split(const RationalVec3& row, const Rational& shift) {
  SplitRow result;
  for (std::size_t i = 0; i < result.entries.size(); ++i) {
    const bool is_shift = i == 3;
    const Rational& exact = is_shift ? shift : row[i];
    Split& entry = result.entries[i];
    entry.high = exact.nearest_double();
    if (is_shift ? !(std::abs(entry.high) <= kLargestShift) : !detail::is_safe(entry.high)) {
      result.is_safe = false;
      return result;
    }
    const auto [head, tail] = detail::split(entry.high);
    entry.high_head = head;
    entry.high_tail = tail;
    Rational rest = exact - Rational(entry.high);
    entry.low = rest.nearest_double();
    if (!is_shift && !detail::is_safe(entry.low)) entry.low = 0;
    rest -= Rational(entry.low);
    if (rest.sign() != 0) entry.error = std::max(rest.abs().upper_double(), kSmallestError);
  }
  return result;
}

Vec3 AffineMap::apply_rounded(PointRef point) const {
  const Vec3& p = point.approx;
  const bool safe = point.is_double() && detail::is_safe(p.x) && detail::is_safe(p.y) && detail::is_safe(p.z);
  const Coordinates coordinates{Coordinate(safe ? p.x : 0), Coordinate(safe ? p.y : 0), Coordinate(safe ? p.z : 0)};
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (safe && split_[axis].is_safe) {
      const RowFilter filter{split_[axis], coordinates};
      Estimate estimate = filter.quick();
      if (!estimate.decides_rounding()) estimate = filter.thorough();
      if (estimate.decides_rounding()) {
        result[axis] = estimate.high + 0.0;  // no negative zero
        continue;
      }
    }
    detail::count_big_fallback();
    result[axis] = (dot(rows_[axis], point.rational()) + shift_[axis]).nearest_double() + 0.0;
  }
  return result;
}

bool AffineMap::image_is_double(PointRef point, const Vec3& rounded) const {
  const Vec3& p = point.approx;
  if (!is_finite(rounded)) return false;
  const bool safe = point.is_double() && detail::is_safe(p.x) && detail::is_safe(p.y) && detail::is_safe(p.z);
  const Coordinates coordinates{Coordinate(safe ? p.x : 0), Coordinate(safe ? p.y : 0), Coordinate(safe ? p.z : 0)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (safe && split_[axis].is_safe) {
      const RowFilter filter{split_[axis], coordinates};
      Estimate estimate = filter.quick();
      if (estimate.error != 0 && estimate.error >= std::abs(estimate.low)) estimate = filter.thorough();
      // Of two doubles whose sum rounds to the first, a second that is not zero is never lost in the first.
      if (estimate.error < std::abs(estimate.low) && estimate.high == rounded[axis]) return false;
      if (estimate.error == 0 && estimate.high != rounded[axis]) return false;
      if (estimate.error == 0) continue;
    }
    if (dot(rows_[axis], point.rational()) + shift_[axis] != Rational(rounded[axis])) return false;
  }
  return true;
}

}  // namespace algebra3d
