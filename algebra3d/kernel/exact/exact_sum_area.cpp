#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/detail/exact_sum_integers.h"
#include "algebra3d/kernel/exact/detail/length_estimate.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using detail::BitRange;
using Triangle = std::array<std::uint32_t, 3>;

/// Bits behind the binary point in the sums below. With integer coordinates a triangle that is not degenerate has a
/// normal of length 1 at least, so that the bits cut off are at most 2^-128 of it.
constexpr mp_bitcnt_t kFractionBits = 128;

/// Sum of the lengths of the triangles' normals, which are twice the areas, with all coordinates as integers.
class LengthSum {
 public:
  LengthSum(const PointArray& points, const BitRange& range) : points_(points), range_(range) {}

  void add(const Triangle& t) {
    detail::count_big_fallback();
    const Vec3 &a = points_.approx()[t[0]], &b = points_.approx()[t[1]], &c = points_.approx()[t[2]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      detail::set_integer(origin_, a[axis], range_.exponent());
      detail::set_integer(u_[axis], b[axis], range_.exponent());
      detail::set_integer(v_[axis], c[axis], range_.exponent());
      u_[axis] -= origin_;
      v_[axis] -= origin_;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      normal_[i] = u_[j] * v_[k] - u_[k] * v_[j];
    }
    add_length();
  }
  Rational total() const {
    return detail::scaled_rational(sum_, 2L * long{range_.exponent()} - static_cast<long>(kFractionBits), 1);
  }

 private:
  void add_length() {
    const auto zeros = std::ranges::count_if(normal_, [](const mpz_class& c) { return sgn(c) == 0; });
    if (zeros >= 2) {
      // Parallel to two axes, as most triangles of most parts: no root to take.
      sum_ += abs(normal_[0] + normal_[1] + normal_[2]) << kFractionBits;
    } else {
      square_ = normal_[0] * normal_[0] + normal_[1] * normal_[1] + normal_[2] * normal_[2];
      square_ <<= 2 * kFractionBits;
      sum_ += sqrt(square_);
    }
  }

  const PointArray& points_;
  BitRange range_;
  mpz_class origin_, square_, sum_;
  std::array<mpz_class, 3> u_, v_, normal_;
};

/// Root of a rational: cut off behind 128 bits at least, exact if it has no more and its denominator is a power of two.
Rational long_root(const Rational& square) {
  if (square.sign() == 0) return {};
  const RationalAccess::View view(square);
  const auto numerator_bits = static_cast<long>(mpz_sizeinbase(view.numerator(), 2));
  const auto denominator_bits = static_cast<long>(mpz_sizeinbase(view.denominator(), 2));
  // Half the bits of the quotient's scale, so that the root has a whole scale; large enough for any dyadic square.
  const long half_scale = std::max(0L, (260L + denominator_bits - numerator_bits) / 2 + 1) + denominator_bits;
  mpz_class quotient(view.numerator());
  quotient <<= 2 * static_cast<mp_bitcnt_t>(half_scale);
  quotient /= mpz_class(view.denominator());
  return detail::scaled_rational(sqrt(quotient), -half_scale, 1);
}

Rational double_area(const PointArray& points, const Triangle& t) {
  const RationalVec3 a = points[t[0]].rational();
  const RationalVec3 normal = cross(points[t[1]].rational() - a, points[t[2]].rational() - a);
  return long_root(dot(normal, normal));
}

Rational half(const Rational& number) {
  return number / Rational(2);
}

bool are_in_range(const PointArray& points) {
  return std::ranges::all_of(points.approx(), [](const Vec3& p) {
    return detail::LengthEstimate::is_in_range(p.x) && detail::LengthEstimate::is_in_range(p.y) &&
           detail::LengthEstimate::is_in_range(p.z);
  });
}

/// Twice the area as precisely as it takes, where the estimate leaves the rounding open.
Result<Rational> long_sum(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  detail::count_filter_failure();
  BitRange range;
  for (const Vec3& p : points.approx())
    for (std::size_t axis = 0; axis < 3; ++axis) range.extend(p[axis]);
  LengthSum sum(points, range);
  Rational with_exact_corners;
  A3D_TRY(detail::for_each_triangle(triangles, cancel, [&](const Triangle& t) {
    if (detail::has_exact_corner(points, t))
      with_exact_corners += double_area(points, t);
    else
      sum.add(t);
  }));
  return sum.total() + with_exact_corners;
}

/// Exact coordinates minus their roundings, as doubles; nothing if all points are doubles.
class Rests {
 public:
  /// Bounds the error of a rest: two integers cut off to doubles, and their quotient.
  static constexpr double kError = 0x1p-50;

  explicit Rests(const PointArray& points) : points_(points), rests_(points.exact_count() == 0 ? 0 : points.size()) {
    constexpr std::size_t kPointsPerTask = 2'000;
    parallel_for(rests_.size(), kPointsPerTask, [&](std::size_t i) {
      if (const PointRef p = points_[i]; !p.is_double())
        for (std::size_t axis = 0; axis < 3; ++axis) rests_[i][axis] = rest(*p.exact, axis, p.approx[axis]);
    });
  }
  std::array<detail::BoundedPair, 3> coordinates(std::uint32_t point) const {
    std::array<detail::BoundedPair, 3> result;
    const Vec3 &place = points_.approx()[point], &rests = rests_[point];
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] = {place[axis], rests[axis], kError * std::abs(rests[axis])};
    return result;
  }

 private:
  /// X / W - m 2^e = (X - m 2^e W) / W.
  static double rest(const ExactCoordinates& exact, std::size_t axis, double rounded) {
    thread_local mpz_class difference, product;  // NOLINT(misc-const-correctness): set through their pointers
    const detail::IntegerDouble number(rounded);
    mpz_mul_si(product.get_mpz_t(), exact[3], number.mantissa);
    mpz_set(difference.get_mpz_t(), exact[axis]);
    const int exponent = number.mantissa == 0 ? 0 : number.exponent;
    mpz_ptr scaled = exponent >= 0 ? product.get_mpz_t() : difference.get_mpz_t();
    mpz_mul_2exp(scaled, scaled, static_cast<mp_bitcnt_t>(std::abs(exponent)));
    mpz_sub(difference.get_mpz_t(), difference.get_mpz_t(), product.get_mpz_t());
    long difference_exponent = 0, divisor_exponent = 0;
    const double numerator = mpz_get_d_2exp(&difference_exponent, difference.get_mpz_t());
    const double divisor = mpz_get_d_2exp(&divisor_exponent, exact[3]);
    return std::ldexp(numerator / divisor,
                      static_cast<int>(difference_exponent - divisor_exponent) + std::min(exponent, 0));
  }

  const PointArray& points_;
  std::vector<Vec3> rests_;
};

/// Bounds of twice the area, for points in range.
Result<detail::LengthEstimate> estimated_sum(const PointArray& points, IndexTriangles triangles,
                                             const std::atomic<bool>* cancel) {
  const Rests rests(points);
  detail::LengthEstimate estimate;
  A3D_TRY(detail::for_each_triangle(triangles, cancel, [&](const Triangle& t) {
    if (detail::has_exact_corner(points, t))
      estimate.add(rests.coordinates(t[0]), rests.coordinates(t[1]), rests.coordinates(t[2]));
    else
      estimate.add(points.approx()[t[0]], points.approx()[t[1]], points.approx()[t[2]]);
  }));
  return estimate;
}

}  // namespace

Result<double> nearest_area(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  if (are_in_range(points)) {
    A3D_ASSIGN(const detail::LengthEstimate estimate, estimated_sum(points, triangles, cancel));
    const double high = half(estimate.upper()).nearest_double();
    if (half(estimate.lower()).nearest_double() == high) return high;
  }
  A3D_ASSIGN(const Rational sum, long_sum(points, triangles, cancel));
  return half(sum).nearest_double();
}

}  // namespace algebra3d
