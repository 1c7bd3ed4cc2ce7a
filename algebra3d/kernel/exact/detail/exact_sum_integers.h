#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <gmpxx.h>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "algebra3d/kernel/exact/exact_sum.h"

namespace algebra3d::detail {

// Shared by exact_sum.cpp and exact_sum_area.cpp: doubles as integers times a common power of two.

/// value = mantissa * 2^exponent, exactly.
struct IntegerDouble {
  std::int64_t mantissa = 0;
  int exponent = 0;

  explicit IntegerDouble(double value) {
    const double fraction = std::frexp(value, &exponent);
    mantissa = static_cast<std::int64_t>(fraction * 0x1p53);
    exponent -= 53;
  }
};

/// The range of bits of a set of doubles.
struct BitRange {
  int lowest = std::numeric_limits<int>::max();   ///< all are multiples of 2^lowest
  int highest = std::numeric_limits<int>::min();  ///< and smaller than 2^highest

  bool is_empty() const { return lowest > highest; }
  void extend(double value) {
    if (value == 0) return;
    const IntegerDouble integer(value);
    const std::uint64_t bits = magnitude(integer.mantissa);
    lowest = std::min(lowest, integer.exponent + std::countr_zero(bits));
    highest = std::max(highest, integer.exponent + static_cast<int>(std::bit_width(bits)));
  }
  void extend(const BitRange& other) {
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
  }
  /// Number of bits of the doubles as integers, after division by 2^lowest.
  int bit_count() const { return is_empty() ? 0 : highest - lowest; }
  int exponent() const { return is_empty() ? 0 : lowest; }
};

/// Sets `result` to value / 2^exponent, which must be an integer.
inline void set_integer(mpz_ptr result, double value, int exponent) {
  const IntegerDouble integer(value);
  mpz_set_si(result, integer.mantissa);
  if (integer.mantissa == 0) return;
  const int shift = integer.exponent - exponent;
  if (shift >= 0)
    mpz_mul_2exp(result, result, static_cast<mp_bitcnt_t>(shift));
  else
    mpz_tdiv_q_2exp(result, result, static_cast<mp_bitcnt_t>(-shift));
}

inline void set_integer(mpz_class& result, double value, int exponent) {
  set_integer(result.get_mpz_t(), value, exponent);
}

/// The rational integer * 2^exponent / divisor.
inline Rational scaled_rational(const mpz_class& integer, long exponent, unsigned long divisor) {
  RationalAccess::Owner result = RationalAccess::make();
  mpz_set(mpq_numref(result->value), integer.get_mpz_t());
  mpz_set_ui(mpq_denref(result->value), divisor);
  if (exponent >= 0)
    mpz_mul_2exp(mpq_numref(result->value), integer.get_mpz_t(), static_cast<mp_bitcnt_t>(exponent));
  else
    mpz_mul_2exp(mpq_denref(result->value), mpq_denref(result->value), static_cast<mp_bitcnt_t>(-exponent));
  mpq_canonicalize(result->value);
  return RationalAccess::take(std::move(result));
}

/// True if a corner of the triangle is not a triple of doubles.
inline bool has_exact_corner(const PointArray& points, const std::array<std::uint32_t, 3>& triangle) {
  return points.exact_count() != 0 &&
         std::ranges::any_of(triangle, [&](std::uint32_t corner) { return !points[corner].is_double(); });
}

/// Calls visit(triangle) for all triangles. Interruptible.
template <typename Visit>
Status for_each_triangle(IndexTriangles triangles, const std::atomic<bool>* cancel, Visit visit) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i % 8192 == 0 && cancel != nullptr && cancel->load(std::memory_order_relaxed))
      return Error{ErrorCode::interrupted, "interrupted"};
    visit(triangles[i]);
  }
  return {};
}

}  // namespace algebra3d::detail
