#include "algebra3d/kernel/exact/real_sum.h"

#include <bit>

#include <gmpxx.h>

#include "algebra3d/kernel/exact/detail/exact_sum_integers.h"

namespace algebra3d {
namespace {

constexpr unsigned kDigitBits = 32;
constexpr std::uint64_t kDigitMask = 0xffffffff;
constexpr int kLowestExponent = -1074;
// Each summand adds less than 32 bits to a digit, and 63 are there.
constexpr std::uint64_t kAddsUntilCarry = std::uint64_t{1} << 30U;

}  // namespace

void RealSum::add(double value) {
  constexpr unsigned kFractionBits = 52;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << kFractionBits) - 1);
  const std::uint64_t exponent = (bits >> kFractionBits) & 0x7ffU;
  // Subnormal numbers have the exponent of the smallest normal ones.
  const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | (std::uint64_t{1} << kFractionBits);
  const std::uint64_t position = exponent == 0 ? 0 : exponent - 1;
  const std::size_t digit = position / kDigitBits;
  const unsigned shift = position % kDigitBits;
  const std::uint64_t low = (mantissa & kDigitMask) << shift;
  const std::uint64_t high = ((mantissa >> kDigitBits) << shift) + (low >> kDigitBits);
  const std::int64_t sign = (bits >> 63U) != 0 ? -1 : 1;
  digits_[digit] += sign * static_cast<std::int64_t>(low & kDigitMask);
  digits_[digit + 1] += sign * static_cast<std::int64_t>(high & kDigitMask);
  digits_[digit + 2] += sign * static_cast<std::int64_t>(high >> kDigitBits);
  if (++count_ % kAddsUntilCarry == 0) carry();
}

// After a carry every digit but the top one has 32 bits; the sum of two of them and of all summands until the next
// carry stays below 63.
void RealSum::add(const RealSum& other) {
  RealSum carried = other;
  carried.carry();
  carry();
  for (std::size_t i = 0; i < kDigits; ++i) digits_[i] += carried.digits_[i];
  count_ += other.count_;
}

void RealSum::carry() {
  for (std::size_t i = 0; i + 1 < kDigits; ++i) {
    const std::int64_t above = digits_[i] >> kDigitBits;  // rounded down, so that the rest is not negative
    digits_[i] -= above * (std::int64_t{1} << kDigitBits);
    digits_[i + 1] += above;
  }
}

Rational RealSum::total() const {
  mpz_class sum;
  for (std::size_t i = kDigits; i-- > 0;) {
    sum <<= kDigitBits;
    sum += digits_[i];
  }
  return detail::scaled_rational(sum, kLowestExponent, 1);
}

}  // namespace algebra3d
