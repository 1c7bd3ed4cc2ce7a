#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include <gmpxx.h>

#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

namespace {

enum class Rounding { nearest, toward_zero, away_from_zero };

constexpr int kMantissaBits = std::numeric_limits<double>::digits;
constexpr int kLowestBit = std::numeric_limits<double>::min_exponent - kMantissaBits;   // -1074, of the subnormals
constexpr int kHighestBit = std::numeric_limits<double>::max_exponent - kMantissaBits;  // 971, last bit of the largest
constexpr int kQuotientBits = kMantissaBits + 2;

/// A positive number by its leading bits: (quotient + something in [0, 1)) / 2^scale; the something is 0 if `exact`.
struct Leading {
  std::uint64_t quotient;
  bool exact;
  long scale;
};

/// Rounds once, to the precision that a double has at this magnitude; `leading` has at least kQuotientBits bits.
RoundedQuotient round_leading(const Leading& leading, Rounding rounding) {
  const long last_bit =
      std::max<long>(static_cast<long>(std::bit_width(leading.quotient)) - leading.scale - kMantissaBits, kLowestBit);
  if (last_bit > kHighestBit) {
    return rounding == Rounding::toward_zero ? RoundedQuotient{std::numeric_limits<double>::max(), 1}
                                             : RoundedQuotient{std::numeric_limits<double>::infinity(), -1};
  }
  const long dropped_bits = last_bit + leading.scale;  // at least 2
  // At 64 and beyond, all bits are dropped, and the rest is less than half of the lowest bit.
  const std::uint64_t kept = dropped_bits > 63 ? 0 : leading.quotient >> dropped_bits;
  const std::uint64_t dropped = dropped_bits > 63 ? 1 : leading.quotient - (kept << dropped_bits);
  const std::uint64_t half = dropped_bits > 63 ? 2 : std::uint64_t{1} << (dropped_bits - 1);
  const bool inexact = dropped != 0 || !leading.exact;
  bool up = rounding == Rounding::away_from_zero && inexact;
  if (rounding == Rounding::nearest) {
    up = dropped > half || (dropped == half && (!leading.exact || kept % 2 == 1));
  }
  // Infinite if rounding up has carried beyond the largest double.
  const double result = std::ldexp(static_cast<double>(kept + (up ? 1 : 0)), static_cast<int>(last_bit));
  return {result, up ? -1 : inexact ? 1 : 0};
}

Leading leading_of(std::uint64_t numerator, std::uint64_t denominator) {
  assert(numerator != 0 && denominator != 0);
  const int scale =
      kQuotientBits - (static_cast<int>(std::bit_width(numerator)) - static_cast<int>(std::bit_width(denominator)));
  const UInt128 dividend = UInt128{numerator} << std::max(scale, 0);
  const UInt128 divisor = UInt128{denominator} << std::max(-scale, 0);
  return {static_cast<std::uint64_t>(dividend / divisor), dividend % divisor == 0, scale};
}

/// The `count` <= 128 leading bits of a positive number of `bits` bits; zeros follow one that has fewer.
UInt128 leading_bits(mpz_srcptr number, long bits, long count) {
  const auto limb = [number](long i) { return UInt128{i < 0 ? 0 : mpz_getlimbn(number, i)}; };
  const long top = (bits - 1) / 64;
  const auto unused = static_cast<unsigned>(64 * (top + 1) - bits);  // of the bits of the top limb
  UInt128 first = limb(top) << 64U | limb(top - 1);
  if (unused > 0) first = first << unused | limb(top - 2) >> (64U - unused);
  return first >> static_cast<unsigned>(128 - count);
}

/// For positive numbers. Uses their first bits alone, where these suffice.
Leading leading_of(mpz_srcptr numerator, mpz_srcptr denominator) {
  const auto numerator_bits = static_cast<long>(mpz_sizeinbase(numerator, 2));
  const auto denominator_bits = static_cast<long>(mpz_sizeinbase(denominator, 2));
  constexpr long kDivisorBits = 64, kDividendBits = 127, kUnsureBits = 7;
  const UInt128 divisor_bits = leading_bits(denominator, denominator_bits, kDivisorBits);
  assert(divisor_bits != 0);
  const UInt128 first = leading_bits(numerator, numerator_bits, kDividendBits) / divisor_bits;
  // The bits cut off change this by less than 2 of at least 2^62, up or down.
  const auto quotient = static_cast<std::uint64_t>(first);
  if ((quotient - 2) >> kUnsureBits == (quotient + 2) >> kUnsureBits && quotient < UINT64_MAX - 2)
    return {quotient >> kUnsureBits, false,
            kDividendBits - kDivisorBits - kUnsureBits - (numerator_bits - denominator_bits)};
  const long scale = kQuotientBits - (numerator_bits - denominator_bits);
  thread_local mpz_class dividend, divisor;
  mpz_mul_2exp(dividend.get_mpz_t(), numerator, static_cast<mp_bitcnt_t>(std::max(scale, 0L)));
  mpz_mul_2exp(divisor.get_mpz_t(), denominator, static_cast<mp_bitcnt_t>(std::max(-scale, 0L)));
  mpz_tdiv_qr(dividend.get_mpz_t(), divisor.get_mpz_t(), dividend.get_mpz_t(), divisor.get_mpz_t());
  return {dividend.get_ui(), sgn(divisor) == 0, scale};
}

double round_magnitude(const Rational& number, Rounding rounding) {
  if (number.sign() == 0) return 0;
  if (number.is_small()) {
    return round_leading(leading_of(magnitude(RationalAccess::small_numerator(number)),
                                    magnitude(RationalAccess::small_denominator(number))),
                         rounding)
        .value;
  }
  const RationalAccess::View view(number);
  thread_local mpz_class numerator;
  mpz_abs(numerator.get_mpz_t(), view.numerator());
  return round_leading(leading_of(numerator.get_mpz_t(), view.denominator()), rounding).value;
}

}  // namespace

RoundedQuotient round_quotient(mpz_srcptr numerator, mpz_srcptr denominator) {
  const int sign = mpz_sgn(numerator);
  if (sign == 0) return {0, 0};
  thread_local mpz_class magnitude;
  mpz_abs(magnitude.get_mpz_t(), numerator);
  const RoundedQuotient rounded = round_leading(leading_of(magnitude.get_mpz_t(), denominator), Rounding::nearest);
  return {sign * rounded.value + 0.0, sign * rounded.beyond};
}

double Rational::nearest_double() const {
  const double rounded = round_magnitude(*this, Rounding::nearest);
  return sign() < 0 ? -rounded : rounded;
}

double Rational::lower_double() const {
  return sign() < 0 ? -round_magnitude(*this, Rounding::away_from_zero) : round_magnitude(*this, Rounding::toward_zero);
}

double Rational::upper_double() const {
  return sign() < 0 ? -round_magnitude(*this, Rounding::toward_zero) : round_magnitude(*this, Rounding::away_from_zero);
}

// With an integer k, the root of this number times 2^k has an integer part r of at least 64 bits. Between r and r + 1
// lies no number that is a double or half-way between two, so that r + 1/2 stands for every root that is not r itself.
double Rational::nearest_root() const {
  assert(sign() >= 0);
  if (sign() == 0) return 0;
  const RationalAccess::View view(*this);
  const auto numerator_bits = static_cast<long>(mpz_sizeinbase(view.numerator(), 2));
  const auto denominator_bits = static_cast<long>(mpz_sizeinbase(view.denominator(), 2));
  const auto k = static_cast<mp_bitcnt_t>(std::max(0L, (denominator_bits - numerator_bits) / 2 + 66));
  RationalAccess::Owner root = RationalAccess::make();
  mpz_ptr square = mpq_numref(root->value);
  mpz_ptr remainder = mpq_denref(root->value);
  mpz_mul_2exp(square, view.numerator(), 2 * k);
  mpz_tdiv_qr(square, remainder, square, view.denominator());
  bool exact = mpz_sgn(remainder) == 0;
  mpz_sqrtrem(square, remainder, square);
  exact = exact && mpz_sgn(remainder) == 0;
  mpz_mul_2exp(square, square, 1);
  if (!exact) mpz_add_ui(square, square, 1);
  mpz_set_ui(remainder, 1);
  mpz_mul_2exp(remainder, remainder, k + 1);
  mpq_canonicalize(root->value);
  return RationalAccess::take(std::move(root)).nearest_double();
}

bool Rational::is_dyadic() const {
  if (is_small()) return std::has_single_bit(static_cast<std::uint64_t>(denominator_));
  const RationalAccess::View view(*this);
  return mpz_scan1(view.denominator(), 0) + 1 == mpz_sizeinbase(view.denominator(), 2);
}

bool Rational::is_double() const {
  if (is_small()) {
    const std::uint64_t numerator = magnitude(numerator_);
    return std::has_single_bit(static_cast<std::uint64_t>(denominator_)) &&
           (numerator == 0 ||
            static_cast<int>(std::bit_width(numerator)) - std::countr_zero(numerator) <= kMantissaBits);
  }
  // In lowest terms: either the denominator is 1, or it is a power of two and the numerator is odd.
  const RationalAccess::View view(*this);
  const auto denominator_bits = static_cast<long>(mpz_sizeinbase(view.denominator(), 2)) - 1;
  if (mpz_scan1(view.denominator(), 0) != static_cast<mp_bitcnt_t>(denominator_bits)) return false;
  const auto numerator_bits = static_cast<long>(mpz_sizeinbase(view.numerator(), 2));
  const auto zeros = static_cast<long>(mpz_scan1(view.numerator(), 0));
  return numerator_bits - zeros <= kMantissaBits && denominator_bits <= -kLowestBit &&
         numerator_bits - denominator_bits <= std::numeric_limits<double>::max_exponent;
}

}  // namespace algebra3d
