#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <gmp.h>

#include "algebra3d/kernel/exact/detail/exact_sum_integers.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"

namespace algebra3d::detail {

/// A signed integer of fixed size: magnitude, lowest limb first, and sign.
template <std::size_t Limbs>
struct WideInteger {
  std::array<std::uint64_t, Limbs> limbs{};
  bool is_negative = false;
};

template <std::size_t N, std::size_t M>
WideInteger<N + M> operator*(const WideInteger<N>& a, const WideInteger<M>& b) {
  WideInteger<N + M> product;
  product.is_negative = a.is_negative != b.is_negative;
  for (std::size_t i = 0; i < N; ++i) {
    UInt128 carried = 0;
    for (std::size_t j = 0; j < M; ++j) {
      carried += UInt128{a.limbs[i]} * b.limbs[j] + product.limbs[i + j];
      product.limbs[i + j] = static_cast<std::uint64_t>(carried);
      carried >>= 64U;
    }
    product.limbs[i + M] = static_cast<std::uint64_t>(carried);
  }
  return product;
}

/// A sum of signed numbers in two's complement. `Limbs` must be large enough that it cannot overflow.
template <std::size_t Limbs>
class WideSum {
 public:
  template <std::size_t N>
  WideSum& add(const WideInteger<N>& number) {
    static_assert(N <= Limbs);
    // Subtracting is adding the complement and one.
    const std::uint64_t flip = number.is_negative ? ~std::uint64_t{0} : 0;
    UInt128 carried = number.is_negative ? 1 : 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      carried += UInt128{limbs_[i]} + ((i < N ? number.limbs[i] : 0) ^ flip);
      limbs_[i] = static_cast<std::uint64_t>(carried);
      carried >>= 64U;
    }
    return *this;
  }
  template <std::size_t N>
  WideSum& subtract(WideInteger<N> number) {
    number.is_negative = !number.is_negative;
    return add(number);
  }

  WideInteger<Limbs> total() const {
    if ((limbs_[Limbs - 1] >> 63U) == 0) return {limbs_, false};
    WideSum negated;
    negated.add(WideInteger<Limbs>{limbs_, true});
    return {negated.limbs_, true};
  }

 private:
  std::array<std::uint64_t, Limbs> limbs_{};
};

template <std::size_t Limbs>
void set_integer(mpz_ptr result, const WideInteger<Limbs>& number) {
  static_assert(sizeof(mp_limb_t) == sizeof(std::uint64_t));
  std::ranges::copy(number.limbs, mpz_limbs_write(result, Limbs));
  mpz_limbs_finish(result, number.is_negative ? -static_cast<mp_size_t>(Limbs) : static_cast<mp_size_t>(Limbs));
}

/// value / 2^exponent, which must be an integer below 2^(64 * Limbs).
template <std::size_t Limbs>
WideInteger<Limbs> wide_integer(double value, int exponent) {
  const IntegerDouble integer(value);
  WideInteger<Limbs> result;
  if (value == 0) return result;
  result.is_negative = value < 0;
  const std::uint64_t bits = magnitude(integer.mantissa);
  const int shift = integer.exponent - exponent;
  if (shift < 0) {
    // Only zeros are shifted out, at most 52 of them.
    result.limbs[0] = bits >> static_cast<unsigned>(-shift);
    return result;
  }
  const UInt128 shifted = UInt128{bits} << static_cast<unsigned>(shift % 64);
  const auto limb = static_cast<std::size_t>(shift / 64);
  result.limbs[limb] = static_cast<std::uint64_t>(shifted);
  if (limb + 1 < Limbs) result.limbs[limb + 1] = static_cast<std::uint64_t>(shifted >> 64U);
  return result;
}

}  // namespace algebra3d::detail
