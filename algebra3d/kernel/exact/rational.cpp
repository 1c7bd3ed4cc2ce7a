#include "algebra3d/kernel/exact/rational.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "base/interruption_scope.h"

namespace algebra3d {

// Integers go to and from GMP as `long`, and magnitudes as one limb.
static_assert(sizeof(long) == sizeof(std::int64_t) && sizeof(mp_limb_t) == sizeof(std::uint64_t) && GMP_NAIL_BITS == 0);

namespace {

constexpr std::uint64_t kMaxInt64 = std::numeric_limits<std::int64_t>::max();

void set_magnitude(mpz_ptr number, UInt128 value) {
  const std::array<std::uint64_t, 2> limbs{static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(value >> 64)};
  mpz_import(number, limbs.size(), -1, sizeof(std::uint64_t), 0, 0, limbs.data());
}

// Most numbers come from doubles, so most denominators are powers of two: there the divisor is a matter of zero bits.
std::uint64_t gcd_of(std::uint64_t a, std::uint64_t b) {
  if (!std::has_single_bit(b)) return std::gcd(a, b);
  const std::uint64_t lowest_bit = a & (0 - a);
  return lowest_bit == 0 || lowest_bit > b ? b : lowest_bit;
}

std::size_t mix(std::size_t seed, std::uint64_t word) {
  // The finaliser of a 64-bit congruential hash: every bit of the word reaches every bit of the result.
  std::uint64_t z = seed + 0x9e3779b97f4a7c15U + word;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

}  // namespace

namespace detail {

std::size_t mix_limbs(std::size_t seed, mpz_srcptr number) {
  seed = mix(seed, static_cast<std::uint64_t>(mpz_sgn(number)));
  for (std::size_t i = 0; i < mpz_size(number); ++i) seed = mix(seed, mpz_getlimbn(number, static_cast<mp_size_t>(i)));
  return seed;
}

}  // namespace detail

RationalAccess::View::View(const Rational& number) : value_(small_) {
  if (number.big_ != nullptr) {
    value_ = number.big_->value;
    return;
  }
  numerator_limb_ = magnitude(number.numerator_);
  denominator_limb_ = static_cast<std::uint64_t>(number.denominator_);
  mpz_roinit_n(mpq_numref(small_), &numerator_limb_, number.sign());
  mpz_roinit_n(mpq_denref(small_), &denominator_limb_, 1);
}

Rational RationalAccess::take(Owner big) {
  Rational result;
  mpz_srcptr numerator = mpq_numref(big->value);
  mpz_srcptr denominator = mpq_denref(big->value);
  if (mpz_fits_slong_p(numerator) != 0 && mpz_fits_slong_p(denominator) != 0) {
    result.numerator_ = mpz_get_si(numerator);
    result.denominator_ = mpz_get_si(denominator);
  } else {
    detail::count_heap_rational();
    result.big_ = big.release();
  }
  return result;
}

Rational RationalAccess::quotient(mpz_srcptr numerator, mpz_srcptr denominator) {
  poll_interruption();
  Owner result = make();
  mpz_set(mpq_numref(result->value), numerator);
  mpz_set(mpq_denref(result->value), denominator);
  mpq_canonicalize(result->value);
  return take(std::move(result));
}

Rational RationalAccess::from_terms(bool negative, UInt128 numerator, UInt128 denominator) {
  Rational result;
  if (numerator <= kMaxInt64 + UInt128{negative} && denominator <= kMaxInt64) {
    const auto bits = static_cast<std::uint64_t>(numerator);
    result.numerator_ = static_cast<std::int64_t>(negative ? 0 - bits : bits);
    result.denominator_ = static_cast<std::int64_t>(denominator);
    return result;
  }
  Owner big = make();
  set_magnitude(mpq_numref(big->value), numerator);
  set_magnitude(mpq_denref(big->value), denominator);
  if (negative) mpz_neg(mpq_numref(big->value), mpq_numref(big->value));
  return take(std::move(big));
}

Rational Rational::from_unsigned(std::uint64_t integer) {
  return RationalAccess::from_terms(false, integer, 1);
}

Rational::Big* Rational::copy_of(const Big& other) {
  RationalAccess::Owner copy = RationalAccess::make();
  mpq_set(copy->value, other.value);
  detail::count_heap_rational();
  return copy.release();
}

void Rational::destroy(Big* big) noexcept {
  delete big;
}

bool Rational::equal_big(const Big& a, const Big& b) {
  return mpq_equal(a.value, b.value) != 0;
}

int Rational::big_sign() const {
  return mpq_sgn(big_->value);
}

bool Rational::is_integer() const {
  return big_ == nullptr ? denominator_ == 1 : mpz_cmp_ui(mpq_denref(big_->value), 1) == 0;
}

Rational::Rational(std::int64_t numerator, std::int64_t denominator) {
  assert(denominator != 0);
  const std::uint64_t n = magnitude(numerator);
  const std::uint64_t d = magnitude(denominator);
  const std::uint64_t common = gcd_of(n, d);
  *this = RationalAccess::from_terms((numerator < 0) != (denominator < 0) && n != 0, n / common, d / common);
}

Rational::Rational(double value) {
  assert(std::isfinite(value));
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  if (mantissa == 0) return;
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  mantissa /= std::int64_t{1} << zeros;
  exponent += zeros;
  if (exponent <= 0 && exponent > -63) {
    numerator_ = mantissa;
    denominator_ = std::int64_t{1} << -exponent;
  } else if (exponent > 0 && std::abs(value) < 0x1p63) {
    numerator_ = static_cast<std::int64_t>(value);
  } else {
    RationalAccess::Owner big = RationalAccess::make();
    mpq_set_d(big->value, value);
    *this = RationalAccess::take(std::move(big));
  }
}

Rational Rational::operator-() const {
  if (big_ == nullptr) {
    return RationalAccess::from_terms(numerator_ > 0, magnitude(numerator_), static_cast<std::uint64_t>(denominator_));
  }
  RationalAccess::Owner result = RationalAccess::make();
  mpq_neg(result->value, big_->value);
  return RationalAccess::take(std::move(result));
}

namespace {

struct Terms {
  std::int64_t numerator, denominator;

  explicit Terms(const Rational& number)
      : numerator(RationalAccess::small_numerator(number)), denominator(RationalAccess::small_denominator(number)) {}
};

Rational signed_terms(Int128 numerator, UInt128 denominator) {
  const bool negative = numerator < 0;
  const auto bits = static_cast<UInt128>(numerator);
  return RationalAccess::from_terms(negative, negative ? 0 - bits : bits, denominator);
}

// Sum or difference in lowest terms with the smallest intermediate values [knuth1997, 4.5.1]: with g = gcd(b, d) only
// factors of g can cancel. |a d + b c| < 2^127, so nothing overflows.
Rational add_small(const Terms& s, const Terms& t, bool subtract) {
  const Int128 other = subtract ? -Int128{t.numerator} : Int128{t.numerator};
  if (s.denominator == 1 && t.denominator == 1) return signed_terms(s.numerator + other, 1);
  const auto b = static_cast<std::uint64_t>(s.denominator);
  const auto d = static_cast<std::uint64_t>(t.denominator);
  const std::uint64_t g = b == d ? b : gcd_of(b, d);
  assert(g != 0);
  const Int128 sum = Int128{s.numerator} * Int128{d / g} + other * Int128{b / g};
  if (g == 1) return signed_terms(sum, UInt128{b} * d);
  const auto sum_magnitude = static_cast<UInt128>(sum < 0 ? -sum : sum);
  const std::uint64_t common = gcd_of(static_cast<std::uint64_t>(sum_magnitude % g), g);
  return signed_terms(sum / Int128{common}, UInt128{b / g} * (d / common));
}

// (n1 / d1) * (n2 / d2) for magnitudes; crosswise reduction leaves the product in lowest terms.
Rational multiply_small(bool negative, std::uint64_t n1, std::uint64_t d1, std::uint64_t n2, std::uint64_t d2) {
  const std::uint64_t g = d2 == 1 ? 1 : gcd_of(n1, d2);
  const std::uint64_t h = d1 == 1 ? 1 : gcd_of(n2, d1);
  return RationalAccess::from_terms(negative && n1 != 0 && n2 != 0, UInt128{n1 / g} * (n2 / h),
                                    UInt128{d1 / h} * (d2 / g));
}

template <typename Operation>
Rational with_gmp(Operation operation, const Rational& a, const Rational& b) {
  poll_interruption();
  const RationalAccess::View s(a);
  const RationalAccess::View t(b);
  RationalAccess::Owner result = RationalAccess::make();
  operation(result->value, s.get(), t.get());
  return RationalAccess::take(std::move(result));
}

}  // namespace

Rational operator+(const Rational& a, const Rational& b) {
  if (a.is_small() && b.is_small()) return add_small(Terms(a), Terms(b), false);
  return with_gmp(mpq_add, a, b);
}

Rational operator-(const Rational& a, const Rational& b) {
  if (a.is_small() && b.is_small()) return add_small(Terms(a), Terms(b), true);
  return with_gmp(mpq_sub, a, b);
}

Rational operator*(const Rational& a, const Rational& b) {
  if (!a.is_small() || !b.is_small()) return with_gmp(mpq_mul, a, b);
  const Terms s(a);
  const Terms t(b);
  return multiply_small((s.numerator < 0) != (t.numerator < 0), magnitude(s.numerator), magnitude(s.denominator),
                        magnitude(t.numerator), magnitude(t.denominator));
}

Rational operator/(const Rational& a, const Rational& b) {
  assert(b.sign() != 0);
  if (!a.is_small() || !b.is_small()) return with_gmp(mpq_div, a, b);
  const Terms s(a);
  const Terms t(b);
  return multiply_small((s.numerator < 0) != (t.numerator < 0), magnitude(s.numerator), magnitude(s.denominator),
                        magnitude(t.denominator), magnitude(t.numerator));
}

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  if (a.is_small() && b.is_small()) {
    const Int128 left = Int128{a.numerator_} * b.denominator_;
    const Int128 right = Int128{b.numerator_} * a.denominator_;
    return left < right   ? std::strong_ordering::less
           : left > right ? std::strong_ordering::greater
                          : std::strong_ordering::equal;
  }
  poll_interruption();
  return mpq_cmp(RationalAccess::View(a).get(), RationalAccess::View(b).get()) <=> 0;
}

std::size_t Rational::hash() const {
  if (big_ == nullptr)
    return mix(mix(0, static_cast<std::uint64_t>(numerator_)), static_cast<std::uint64_t>(denominator_));
  return detail::mix_limbs(detail::mix_limbs(1, mpq_numref(big_->value)), mpq_denref(big_->value));
}

}  // namespace algebra3d
