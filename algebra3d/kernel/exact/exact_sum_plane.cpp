#include "algebra3d/kernel/exact/exact_sum_plane.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra3d/kernel/exact/balanced_sum.h"
#include "algebra3d/kernel/exact/detail/exact_sum_integers.h"
#include "algebra3d/kernel/exact/detail/exact_sum_wide.h"
#include "algebra3d/kernel/exact/expansion.h"

namespace algebra3d {
namespace {

using detail::BitRange;
using detail::two_product;
using detail::two_sum;

/// Calls visit(a, b) for the segments of the closed line.
template <typename Visit>
void for_each_segment(std::size_t begin, std::size_t end, Visit visit) {
  for (std::size_t i = begin; i < end; ++i) visit(i, i + 1 == end ? begin : i + 1);
}

/// Sum of the determinants of positions, whose coordinates are integers of at most 64 * Limbs - 4 bits.
template <std::size_t Limbs>
class WideDeterminants {
 public:
  explicit WideDeterminants(int exponent) : exponent_(exponent) {}

  void add(const Vec3& a, const Vec3& b) {
    sum_.add(wide(a.x) * wide(b.y));
    sum_.subtract(wide(b.x) * wide(a.y));
  }
  void get(mpz_class& result) const { detail::set_integer(result.get_mpz_t(), sum_.total()); }

 private:
  detail::WideInteger<Limbs> wide(double value) const { return detail::wide_integer<Limbs>(value, exponent_); }

  int exponent_;
  detail::WideSum<2 * Limbs + 1> sum_;  // one limb more for the number of points
};

/// Sums of determinants in integers of any size.
class LongDeterminants {
 public:
  explicit LongDeterminants(int exponent) : exponent_(exponent) {}

  void add(const Vec3& a, const Vec3& b) {
    detail::set_integer(first_, a.x, exponent_);
    detail::set_integer(second_, b.y, exponent_);
    sum_ += first_ * second_;
    detail::set_integer(first_, b.x, exponent_);
    detail::set_integer(second_, a.y, exponent_);
    sum_ -= first_ * second_;
  }
  void get(mpz_class& result) const { result = sum_; }

 private:
  int exponent_;
  mpz_class first_, second_, sum_;
};

template <typename Determinants>
Rational doubled_area_with(const PointArray& points, std::size_t begin, std::size_t end, int exponent) {
  Determinants determinants(exponent);
  detail::BalancedSum rational;
  for_each_segment(begin, end, [&](std::size_t a, std::size_t b) {
    const PointRef from = points[a], to = points[b];
    if (from.is_double() && to.is_double())
      determinants.add(from.approx, to.approx);
    else
      rational.add(from.coordinate(0) * to.coordinate(1) - to.coordinate(0) * from.coordinate(1));
  });
  mpz_class sum;
  determinants.get(sum);
  return detail::scaled_rational(sum, 2L * long{exponent}, 1) + rational.total();
}

/// The length of a segment as a sum of two doubles, right to some 100 bits.
detail::Rounded length_of_doubles(const Vec3& a, const Vec3& b) {
  const auto square = [](const detail::Rounded& d) {
    const auto [value, rest] = two_product(d.value, d.value, detail::split(d.value));
    return detail::Rounded{value, rest + 2 * d.value * d.rest};
  };
  const detail::Rounded x = square(two_sum(b.x, -a.x)), y = square(two_sum(b.y, -a.y));
  const auto [value, rest] = two_sum(x.value, y.value);
  if (value == 0) return {0, 0};
  const double root = std::sqrt(value);
  const detail::Rounded squared = two_product(root, root, detail::split(root));
  return {root, (((value - squared.value) - squared.rest) + (rest + x.rest + y.rest)) / (2 * root)};
}

double length_of_rationals(const PointRef& a, const PointRef& b) {
  const Rational x = b.coordinate(0) - a.coordinate(0), y = b.coordinate(1) - a.coordinate(1);
  return (x * x + y * y).nearest_root();
}

}  // namespace

Rational exact_doubled_area(const PointArray& points, std::size_t begin, std::size_t end) {
  BitRange range;
  for (std::size_t i = begin; i < end; ++i) {
    range.extend(points.approx()[i].x);
    range.extend(points.approx()[i].y);
  }
  const int bits = range.bit_count(), exponent = range.exponent();
  if (bits <= 60) return doubled_area_with<WideDeterminants<1>>(points, begin, end, exponent);
  if (bits <= 124) return doubled_area_with<WideDeterminants<2>>(points, begin, end, exponent);
  return doubled_area_with<LongDeterminants>(points, begin, end, exponent);
}

// Scaled so that the largest coordinate is about 1. Nothing overflows then, and numbers that underflow are too small to
// count: where a coordinate is about 1, two different ones near it differ by 2^-54 at least.
double nearest_length(const PointArray& points, std::size_t begin, std::size_t end) {
  double largest = 0;
  for (std::size_t i = begin; i < end; ++i)
    largest = std::max({largest, std::abs(points.approx()[i].x), std::abs(points.approx()[i].y)});
  int exponent = 0;
  std::frexp(largest, &exponent);
  const auto scaled = [&](const Vec3& v) { return Vec3{std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), 0}; };
  double total = 0, rests = 0;
  for_each_segment(begin, end, [&](std::size_t a, std::size_t b) {
    const PointRef from = points[a], to = points[b];
    const detail::Rounded length = from.is_double() && to.is_double()
                                       ? length_of_doubles(scaled(from.approx), scaled(to.approx))
                                       : detail::Rounded{std::ldexp(length_of_rationals(from, to), -exponent), 0};
    const auto [sum, rest] = two_sum(total, length.value);
    total = sum;
    rests += rest + length.rest;
  });
  return std::ldexp(total + rests, exponent);
}

}  // namespace algebra3d
