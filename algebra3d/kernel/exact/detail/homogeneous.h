#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <gmpxx.h>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::detail {

/// Homogeneous coordinates of a point: x = X / W and so on, all integers, W > 0. Their determinants need no fractions
/// and so no greatest common divisors, which dominate the cost of rational arithmetic.
struct HomogeneousPoint {
  mpz_class x, y, z, w;

  mpz_srcptr operator[](std::size_t axis) const {
    return (axis == 0 ? x : axis == 1 ? y : axis == 2 ? z : w).get_mpz_t();
  }
  mpz_ptr operator[](std::size_t axis) { return (axis == 0 ? x : axis == 1 ? y : axis == 2 ? z : w).get_mpz_t(); }
  /// Sets the coordinates, in lowest terms.
  void set(const RationalVec3& point);
  void set(const Vec3& doubles);
  /// Brings fractions with positive denominators to one denominator; with common divisors if their terms are not
  /// lowest.
  void set_fractions(const std::array<mpz_srcptr, 3>& numerators, const std::array<mpz_srcptr, 3>& denominators);
};

/// A view of a constant integer whose limbs lie elsewhere, as GMP's functions take it.
class IntegerView {
 public:
  IntegerView() = default;
  /// `size`: the number of limbs, negative for a negative integer.
  IntegerView(const mp_limb_t* limbs, int size) { mpz_roinit_n(&number_, limbs, size); }
  explicit IntegerView(mpz_srcptr number) : number_(*number) {}

  operator mpz_srcptr() const { return &number_; }  // NOLINT(google-explicit-constructor)
  IntegerView operator-() const { return {number_._mp_d, -number_._mp_size}; }

 private:
  __mpz_struct number_{};
};

/// Homogeneous coordinates that do not change any more: four sizes, and the limbs behind them in the same heap block.
/// So it must be the last member of an object that is allocated with `bytes_behind` more bytes.
class PackedIntegers {
 public:
  explicit PackedIntegers(const HomogeneousPoint& numbers);

  /// The bytes that the limbs of the numbers take.
  static std::size_t bytes_behind(const HomogeneousPoint& numbers);
  std::size_t bytes_behind() const;
  IntegerView operator[](std::size_t i) const {
    const mp_limb_t* limbs = first_limb();
    for (std::size_t before = 0; before < i; ++before) limbs += std::abs(sizes_[before]);
    return {limbs, sizes_[i]};
  }

 private:
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  const mp_limb_t* first_limb() const { return reinterpret_cast<const mp_limb_t*>(this + 1); }

  std::array<std::int32_t, 4> sizes_;  // numbers of limbs, negative for negative integers
};

/// A read-only view of homogeneous coordinates, of an exact point or of numbers elsewhere.
class HomogeneousView {
 public:
  /// For a point of doubles the integers are computed in `buffer`.
  HomogeneousView(const PointRef& point, HomogeneousPoint& buffer);
  HomogeneousView(const HomogeneousPoint& numbers)  // NOLINT(google-explicit-constructor)
      : numbers_{IntegerView(numbers[0]), IntegerView(numbers[1]), IntegerView(numbers[2]), IntegerView(numbers[3])} {}
  explicit HomogeneousView(const std::array<IntegerView, 4>& numbers) : numbers_(numbers) {}

  mpz_srcptr operator[](std::size_t i) const { return numbers_[i]; }

 private:
  std::array<IntegerView, 4> numbers_;
};

/// Divides the numbers, not all of which may be zero, by the powers of two that they have in common; if one has more
/// than `longest_kept` limbs, by their greatest common divisor. Numbers that come from doubles have a common divisor
/// beyond powers of two by chance only, and a short one; finding it takes longer than computing the numbers. Long
/// numbers come from exact ones, and most of them is a common divisor.
void shorten(HomogeneousPoint& numbers, std::size_t longest_kept);
/// The scalar product of the four numbers. For a plane and a point: the value of the plane's equation times W.
void dot(mpz_class& result, const HomogeneousView& a, const HomogeneousView& b);

/// The four numbers orthogonal to three rows: the plane (a, b, c, -d) through three points, with the normal (q - p) x
/// (r - p); or, dually, the common point of three planes, up to its sign.
void join(HomogeneousPoint& result, const HomogeneousView& p, const HomogeneousView& q, const HomogeneousView& r);
/// The plane through three points of doubles, with half the products.
void join(HomogeneousPoint& result, const Vec3& p, const Vec3& q, const Vec3& r);

/// Compares a / b with c / d, where b and d are positive.
std::strong_ordering compare_quotients(mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d);

/// orient3d and orient2d by homogeneous coordinates. Exact for all points. Thread-safe; reuses its numbers between
/// calls.
int orient3d_by_integers(const std::array<const PointRef*, 4>& points);
int orient2d_by_integers(Projection plane, const std::array<const PointRef*, 3>& points);

}  // namespace algebra3d::detail
