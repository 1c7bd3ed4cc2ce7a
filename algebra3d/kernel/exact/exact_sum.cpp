#include "algebra3d/kernel/exact/exact_sum.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/balanced_sum.h"
#include "algebra3d/kernel/exact/detail/exact_sum_integers.h"
#include "algebra3d/kernel/exact/detail/exact_sum_wide.h"
#include "algebra3d/kernel/exact/detail/fixed_sums.h"
#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::BitRange;
using detail::kAxisPairs;
using Triangle = std::array<std::uint32_t, 3>;

/// Per axis, the bits of the coordinates.
using AxisRanges = std::array<BitRange, 3>;

/// Sums over triangles in integers of any size.
class LongSums {
 public:
  LongSums(const PointArray& points, const AxisRanges& ranges) : points_(points), ranges_(ranges) {}

  template <int kDegree>
  void add(const Triangle& t) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        detail::set_integer(corners_[corner][axis], points_.approx()[t[corner]][axis], ranges_[axis].exponent());
    const auto& [a, b, c] = corners_;
    determinant_ = a[0] * (b[1] * c[2] - b[2] * c[1]);
    determinant_ += a[1] * (b[2] * c[0] - b[0] * c[2]);
    determinant_ += a[2] * (b[0] * c[1] - b[1] * c[0]);
    volume_ += determinant_;
    if constexpr (kDegree >= 1) {
      for (std::size_t axis = 0; axis < 3; ++axis) moments_[axis] += determinant_ * (a[axis] + b[axis] + c[axis]);
    }
    if constexpr (kDegree >= 2) {
      for (std::size_t pair = 0; pair < kAxisPairs.size(); ++pair) {
        const auto [i, j] = kAxisPairs[pair];
        second_[pair] += determinant_ * mpz_class((a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j]) + a[i] * a[j] +
                                                  b[i] * b[j] + c[i] * c[j]);
      }
    }
  }
  void get_volume(mpz_class& result) const { result = volume_; }
  void get_moment(std::size_t axis, mpz_class& result) const { result = moments_[axis]; }
  void get_second_moment(std::size_t pair, mpz_class& result) const { result = second_[pair]; }

 private:
  const PointArray& points_;
  AxisRanges ranges_;
  std::array<std::array<mpz_class, 3>, 3> corners_;
  mpz_class determinant_, volume_;
  std::array<mpz_class, 3> moments_;
  std::array<mpz_class, 6> second_;
};

/// Sums over triangles with a corner that is not a double.
class RationalSums {
 public:
  explicit RationalSums(const PointArray& points) : points_(points) {}

  template <int kDegree>
  void add(const Triangle& t) {
    Rational determinant = determinant_of(t);
    if constexpr (kDegree >= 1) {
      const RationalVec3 sum = points_[t[0]].rational() + points_[t[1]].rational() + points_[t[2]].rational();
      moments_[0].add(determinant * sum.x);
      moments_[1].add(determinant * sum.y);
      moments_[2].add(determinant * sum.z);
      if constexpr (kDegree >= 2) add_second(determinant, sum, t);
    }
    volume_.add(std::move(determinant));
  }
  Rational volume() const { return volume_.total(); }
  Rational moment(std::size_t axis) const { return moments_[axis].total(); }
  Rational second_moment(std::size_t pair) const { return second_[pair].total(); }

 private:
  void add_second(const Rational& determinant, const RationalVec3& sum, const Triangle& t) {
    for (std::size_t pair = 0; pair < kAxisPairs.size(); ++pair) {
      const auto [i, j] = kAxisPairs[pair];
      Rational factor = sum[i] * sum[j];
      for (const std::uint32_t corner : t) factor += points_[corner].coordinate(i) * points_[corner].coordinate(j);
      second_[pair].add(determinant * factor);
    }
  }

  /// With a common denominator, so that common divisors are looked for but once.
  Rational determinant_of(const Triangle& t) {
    const detail::HomogeneousView a(points_[t[0]], buffers_[0]), b(points_[t[1]], buffers_[1]),
        c(points_[t[2]], buffers_[2]);
    set_numerator(a, b, c);
    mpz_mul(denominator_.get_mpz_t(), a[3], b[3]);
    mpz_mul(denominator_.get_mpz_t(), denominator_.get_mpz_t(), c[3]);
    return RationalAccess::quotient(numerator_.get_mpz_t(), denominator_.get_mpz_t());
  }

  /// The determinant of the rows (X, Y, Z).
  void set_numerator(const detail::HomogeneousView& a, const detail::HomogeneousView& b,
                     const detail::HomogeneousView& c) {
    numerator_ = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      mpz_mul(minor_.get_mpz_t(), b[j], c[k]);
      mpz_submul(minor_.get_mpz_t(), b[k], c[j]);
      mpz_addmul(numerator_.get_mpz_t(), a[i], minor_.get_mpz_t());
    }
  }

  const PointArray& points_;
  std::array<detail::HomogeneousPoint, 3> buffers_;
  mpz_class minor_, numerator_, denominator_;
  detail::BalancedSum volume_;
  std::array<detail::BalancedSum, 3> moments_;
  std::array<detail::BalancedSum, 6> second_;
};

AxisRanges ranges_of(const PointArray& points) {
  AxisRanges ranges;
  for (const Vec3& p : points.approx())
    for (std::size_t axis = 0; axis < 3; ++axis) ranges[axis].extend(p[axis]);
  return ranges;
}

template <std::size_t Limbs>
detail::FixedSums<Limbs> fixed_sums(const PointArray& points, const AxisRanges& ranges) {
  std::vector<typename detail::FixedSums<Limbs>::Point> integers;
  integers.reserve(points.size());
  for (const Vec3& p : points.approx())
    integers.push_back({detail::wide_integer<Limbs>(p.x, ranges[0].exponent()),
                        detail::wide_integer<Limbs>(p.y, ranges[1].exponent()),
                        detail::wide_integer<Limbs>(p.z, ranges[2].exponent())});
  return detail::FixedSums<Limbs>(std::move(integers));
}

template <int kDegree, typename Sums>
Result<SolidSecondMoments> sum_with(Sums sums, const PointArray& points, const AxisRanges& ranges,
                                    IndexTriangles triangles, const std::atomic<bool>* cancel) {
  RationalSums rational(points);
  A3D_TRY(detail::for_each_triangle(triangles, cancel, [&](const Triangle& t) {
    if (detail::has_exact_corner(points, t))
      rational.template add<kDegree>(t);
    else
      sums.template add<kDegree>(t);
  }));
  const long exponent = long{ranges[0].exponent()} + ranges[1].exponent() + ranges[2].exponent();
  mpz_class total;
  sums.get_volume(total);
  SolidSecondMoments result;
  result.lower.volume = detail::scaled_rational(total, exponent, 6) + rational.volume() / Rational(6);
  if constexpr (kDegree >= 1) {
    const auto moment = [&](std::size_t axis) {
      sums.get_moment(axis, total);
      return detail::scaled_rational(total, exponent + ranges[axis].exponent(), 24) +
             rational.moment(axis) / Rational(24);
    };
    result.lower.first = RationalVec3(moment(0), moment(1), moment(2));
  }
  if constexpr (kDegree >= 2) {
    for (std::size_t pair = 0; pair < kAxisPairs.size(); ++pair) {
      const auto [i, j] = kAxisPairs[pair];
      sums.get_second_moment(pair, total);
      result.second[pair] =
          detail::scaled_rational(total, exponent + ranges[i].exponent() + ranges[j].exponent(), 120) +
          rational.second_moment(pair) / Rational(120);
    }
  }
  return result;
}

template <int kDegree>
Result<SolidSecondMoments> sum(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  const AxisRanges ranges = ranges_of(points);
  const int bits = std::max({ranges[0].bit_count(), ranges[1].bit_count(), ranges[2].bit_count()});
  const auto with = [&](auto sums) { return sum_with<kDegree>(std::move(sums), points, ranges, triangles, cancel); };
  if (bits <= 60) return with(fixed_sums<1>(points, ranges));
  if (bits <= 124) return with(fixed_sums<2>(points, ranges));
  return with(LongSums(points, ranges));
}

}  // namespace

Result<Rational> exact_volume(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  A3D_ASSIGN(SolidSecondMoments sums, sum<0>(points, triangles, cancel));
  return std::move(sums.lower.volume);
}

Result<SolidMoments> exact_moments(const PointArray& points, IndexTriangles triangles,
                                   const std::atomic<bool>* cancel) {
  A3D_ASSIGN(SolidSecondMoments sums, sum<1>(points, triangles, cancel));
  return std::move(sums.lower);
}

Result<SolidSecondMoments> exact_second_moments(const PointArray& points, IndexTriangles triangles,
                                                const std::atomic<bool>* cancel) {
  return sum<2>(points, triangles, cancel);
}

}  // namespace algebra3d
