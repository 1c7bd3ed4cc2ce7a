#pragma once

#include <memory>

#include <gmp.h>

#include "algebra3d/base/int128.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// The part of a rational that does not fit 64 bits. In lowest terms.
struct Rational::Big {
  mpq_t value;

  Big() { mpq_init(value); }
  ~Big() { mpq_clear(value); }
  Big(const Big&) = delete;
  Big(Big&&) = delete;
  Big& operator=(const Big&) = delete;
  Big& operator=(Big&&) = delete;
};

/// Access to the members of a rational for sources of `exact/` that compute with GMP.
class RationalAccess {
 public:
  using Owner = std::unique_ptr<Rational::Big>;

  /// A read-only view of any rational as a GMP number; valid while both the view and the rational exist.
  class View {
   public:
    explicit View(const Rational& number);
    ~View() = default;
    View(const View&) = delete;  // `small_` points into this object
    View(View&&) = delete;
    View& operator=(const View&) = delete;
    View& operator=(View&&) = delete;

    mpq_srcptr get() const { return value_; }
    mpz_srcptr numerator() const { return mpq_numref(value_); }
    mpz_srcptr denominator() const { return mpq_denref(value_); }

   private:
    mp_limb_t numerator_limb_ = 0;
    mp_limb_t denominator_limb_ = 1;
    mpq_t small_;
    mpq_srcptr value_;
  };

  static Owner make() { return std::make_unique<Rational::Big>(); }
  /// Makes a rational of a GMP number; stored in 64 bits if it fits. `big` must be in lowest terms.
  static Rational take(Owner big);
  /// The denominator must be positive; common divisors are allowed.
  static Rational quotient(mpz_srcptr numerator, mpz_srcptr denominator);
  /// A rational from magnitudes and a sign, which must be in lowest terms; the denominator is not zero.
  static Rational from_terms(bool negative, UInt128 numerator, UInt128 denominator);

  static std::int64_t small_numerator(const Rational& number) { return number.numerator_; }
  static std::int64_t small_denominator(const Rational& number) { return number.denominator_; }
};

struct RoundedQuotient {
  double value;  ///< nearest to the quotient, ties to even; never -0; infinite beyond the range of doubles
  int beyond;    ///< sign of the quotient minus `value`
};
/// Rounds a quotient to nearest. The denominator must be positive.
RoundedQuotient round_quotient(mpz_srcptr numerator, mpz_srcptr denominator);

/// Magnitude of any 64-bit integer, the smallest included.
inline std::uint64_t magnitude(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  return value < 0 ? 0 - bits : bits;
}

namespace detail {
/// Combines a hash with that of the number.
std::size_t mix_limbs(std::size_t seed, mpz_srcptr number);
}  // namespace detail

}  // namespace algebra3d
