#include "algebra3d/exact/exact_sum.h"

#include <utility>
#include <vector>

#include "algebra3d/exact/exact_sum_integers.h"

namespace algebra3d {
namespace {

using detail::BigInteger;
using detail::BitRange;
using Triangle = std::array<std::uint32_t, 3>;

/// Per axis, the bits of the coordinates.
using AxisRanges = std::array<BitRange, 3>;

/// Sum of signed numbers as two's complement; `Limbs` has to be chosen so that it cannot overflow.
template <std::size_t Limbs>
class WideSum {
 public:
  template <std::size_t N>
  void add(const std::array<std::uint64_t, N>& number, bool is_negative) {
    static_assert(N <= Limbs);
    // Subtracting is adding the complement and one.
    const std::uint64_t flip = is_negative ? ~std::uint64_t{0} : 0;
    UInt128 carried = is_negative ? 1 : 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      carried += UInt128{limbs_[i]} + ((i < N ? number[i] : 0) ^ flip);
      limbs_[i] = static_cast<std::uint64_t>(carried);
      carried >>= 64U;
    }
  }

  void get(mpz_ptr result) const {
    const bool is_negative = (limbs_[Limbs - 1] >> 63U) != 0;
    WideSum positive = *this;
    if (is_negative) {
      positive = {};
      positive.add(limbs_, true);
    }
    mpz_import(result, Limbs, -1, sizeof(std::uint64_t), 0, 0, positive.limbs_.data());
    if (is_negative) mpz_neg(result, result);
  }

 private:
  std::array<std::uint64_t, Limbs> limbs_{};
};

/// A determinant as sign and magnitude.
struct WideProduct {
  std::array<std::uint64_t, 3> limbs{};
  bool is_negative = false;
};

using ShortPoint = std::array<std::int64_t, 3>;  // entries below 2^60

WideProduct determinant(const ShortPoint& a, const ShortPoint& b, const ShortPoint& c) {
  const auto minor = [&](std::size_t i, std::size_t j) { return Int128{b[i]} * c[j] - Int128{b[j]} * c[i]; };
  const std::array<Int128, 3> minors{minor(1, 2), minor(2, 0), minor(0, 1)};  // below 2^121
  // The sum has up to 183 bits: high * 2^64 + low, neither of which overflows.
  Int128 high = 0, low = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    high += (minors[axis] >> 64) * a[axis];
    low += static_cast<Int128>(static_cast<std::uint64_t>(minors[axis])) * a[axis];
  }
  high += low >> 64;
  auto lowest = static_cast<std::uint64_t>(low);
  WideProduct result;
  result.is_negative = high < 0;
  if (result.is_negative) {
    high = ~high + (lowest == 0 ? 1 : 0);
    lowest = ~lowest + 1;
  }
  result.limbs = {lowest, static_cast<std::uint64_t>(high), static_cast<std::uint64_t>(high >> 64)};
  return result;
}

std::array<std::uint64_t, 4> times(const std::array<std::uint64_t, 3>& number, std::uint64_t factor) {
  std::array<std::uint64_t, 4> result{};
  UInt128 carried = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    carried += UInt128{number[i]} * factor;
    result[i] = static_cast<std::uint64_t>(carried);
    carried >>= 64U;
  }
  result[3] = static_cast<std::uint64_t>(carried);
  return result;
}

/// Sums over triangles whose coordinates are short integers on each axis: all in registers.
class ShortSums {
 public:
  ShortSums(const PointArray& points, const AxisRanges& ranges) {
    points_.reserve(points.size());
    for (const Vec3& p : points.approx())
      points_.push_back({detail::short_integer(p.x, ranges[0].exponent()),
                         detail::short_integer(p.y, ranges[1].exponent()),
                         detail::short_integer(p.z, ranges[2].exponent())});
  }

  template <bool kMoments>
  void add(const Triangle& t) {
    const ShortPoint &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const WideProduct product = determinant(a, b, c);
    volume_.add(product.limbs, product.is_negative);
    if constexpr (kMoments) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t sum = a[axis] + b[axis] + c[axis];
        moments_[axis].add(times(product.limbs, magnitude(sum)), product.is_negative != (sum < 0));
      }
    }
  }
  void get_volume(mpz_ptr result) const { volume_.get(result); }
  void get_moment(std::size_t axis, mpz_ptr result) const { moments_[axis].get(result); }

 private:
  std::vector<ShortPoint> points_;
  // 183 bits per determinant, 62 per sum of coordinates, and 31 for the number of triangles.
  WideSum<4> volume_;
  std::array<WideSum<5>, 3> moments_;
};

/// The same for integers of any size.
class LongSums {
 public:
  LongSums(const PointArray& points, const AxisRanges& ranges) : points_(points), ranges_(ranges) {}

  template <bool kMoments>
  void add(const Triangle& t) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        detail::set_integer(corners_[corner][axis], points_.approx()[t[corner]][axis], ranges_[axis].exponent());
    const auto& [a, b, c] = corners_;
    mpz_set_ui(determinant_, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      mpz_mul(minor_, b[j], c[k]);
      mpz_submul(minor_, b[k], c[j]);
      mpz_addmul(determinant_, a[i], minor_);
    }
    mpz_add(volume_, volume_, determinant_);
    if constexpr (kMoments) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        mpz_add(minor_, a[axis], b[axis]);
        mpz_add(minor_, minor_, c[axis]);
        mpz_addmul(moments_[axis], determinant_, minor_);
      }
    }
  }
  void get_volume(mpz_ptr result) const { mpz_set(result, volume_); }
  void get_moment(std::size_t axis, mpz_ptr result) const { mpz_set(result, moments_[axis]); }

 private:
  const PointArray& points_;
  AxisRanges ranges_;
  std::array<std::array<BigInteger, 3>, 3> corners_;
  BigInteger minor_, determinant_, volume_;
  std::array<BigInteger, 3> moments_;
};

/// Sum of rationals in a balanced tree: denominators that have nothing in common grow with the number of terms, and so
/// the large ones are added few times.
class BalancedSum {
 public:
  void add(Rational term) {
    std::size_t level = 0;
    for (; level < partial_.size() && is_used_[level]; ++level) {
      term += partial_[level];
      is_used_[level] = false;
    }
    if (level == partial_.size()) {
      partial_.emplace_back();
      is_used_.push_back(false);
    }
    partial_[level] = std::move(term);
    is_used_[level] = true;
  }
  Rational total() const {
    Rational sum;
    for (std::size_t level = 0; level < partial_.size(); ++level)
      if (is_used_[level]) sum += partial_[level];
    return sum;
  }

 private:
  std::vector<Rational> partial_;  // at level k the sum of 2^k terms
  std::vector<bool> is_used_;
};

/// The same for triangles with a corner that is no double.
class RationalSums {
 public:
  explicit RationalSums(const PointArray& points) : points_(points) {}

  template <bool kMoments>
  void add(const Triangle& t) {
    const RationalVec3 a = points_[t[0]].rational(), b = points_[t[1]].rational(), c = points_[t[2]].rational();
    const Rational determinant = dot(a, cross(b, c));
    if constexpr (kMoments) {
      const RationalVec3 sum = a + b + c;
      moments_[0].add(determinant * sum.x);
      moments_[1].add(determinant * sum.y);
      moments_[2].add(determinant * sum.z);
    }
    volume_.add(determinant);
  }
  Rational volume() const { return volume_.total(); }
  Rational moment(std::size_t axis) const { return moments_[axis].total(); }

 private:
  const PointArray& points_;
  BalancedSum volume_;
  std::array<BalancedSum, 3> moments_;
};

AxisRanges ranges_of(const PointArray& points) {
  AxisRanges ranges;
  for (const Vec3& p : points.approx())
    for (std::size_t axis = 0; axis < 3; ++axis) ranges[axis].extend(p[axis]);
  return ranges;
}

template <bool kMoments, typename Sums>
Result<SolidMoments> sum_with(const PointArray& points, const AxisRanges& ranges, IndexTriangles triangles,
                              const std::atomic<bool>* cancel) {
  Sums sums(points, ranges);
  RationalSums rational(points);
  RETURN_IF_ERROR(detail::for_each_triangle(triangles, cancel, [&](const Triangle& t) {
    if (detail::has_exact_corner(points, t))
      rational.template add<kMoments>(t);
    else
      sums.template add<kMoments>(t);
  }));
  const long exponent = long{ranges[0].exponent()} + ranges[1].exponent() + ranges[2].exponent();
  BigInteger total;
  sums.get_volume(total);
  SolidMoments result;
  result.volume = detail::scaled_rational(total, exponent, 6) + rational.volume() / Rational(6);
  if constexpr (kMoments) {
    const auto moment = [&](std::size_t axis) {
      sums.get_moment(axis, total);
      return detail::scaled_rational(total, exponent + ranges[axis].exponent(), 24) +
             rational.moment(axis) / Rational(24);
    };
    result.first = RationalVec3(moment(0), moment(1), moment(2));
  }
  return result;
}

template <bool kMoments>
Result<SolidMoments> sum(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  const AxisRanges ranges = ranges_of(points);
  if (ranges[0].is_short() && ranges[1].is_short() && ranges[2].is_short())
    return sum_with<kMoments, ShortSums>(points, ranges, triangles, cancel);
  return sum_with<kMoments, LongSums>(points, ranges, triangles, cancel);
}

}  // namespace

Result<Rational> exact_volume(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  ASSIGN_OR_RETURN(SolidMoments sums, sum<false>(points, triangles, cancel));
  return std::move(sums.volume);
}

Result<SolidMoments> exact_moments(const PointArray& points, IndexTriangles triangles,
                                   const std::atomic<bool>* cancel) {
  return sum<true>(points, triangles, cancel);
}

}  // namespace algebra3d
