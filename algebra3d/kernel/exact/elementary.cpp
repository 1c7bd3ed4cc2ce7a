#include "algebra3d/kernel/exact/elementary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra3d/kernel/exact/detail/mpfr_float.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "base/number_text.h"

namespace algebra3d {
namespace {

/// Results of two roundings, the second of which is to doubles, are those of one: the true value is irrational, and no
/// double that small and its neighbours are so near to a multiple of pi or a quotient of logarithms.
constexpr mpfr_prec_t kManyBits = 320;

/// Gives MPFR the exponents of doubles as long as it lives, so that subnormal results are rounded once.
class RangeOfDoubles {
 public:
  RangeOfDoubles() : least_(mpfr_get_emin()), greatest_(mpfr_get_emax()) {
    // MPFR's fractions are in [1/2, 1), and the least double is 2^-1074.
    mpfr_set_emin(std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits + 1);
    mpfr_set_emax(std::numeric_limits<double>::max_exponent);
  }
  ~RangeOfDoubles() {
    mpfr_set_emin(least_);
    mpfr_set_emax(greatest_);
  }
  RangeOfDoubles(const RangeOfDoubles&) = delete;
  RangeOfDoubles(RangeOfDoubles&&) = delete;
  RangeOfDoubles& operator=(const RangeOfDoubles&) = delete;
  RangeOfDoubles& operator=(RangeOfDoubles&&) = delete;

 private:
  mpfr_exp_t least_, greatest_;
};

MpfrFloat& set(MpfrFloat& number, double value) {
  mpfr_set_d(number.get(), value, MPFR_RNDN);
  return number;
}

/// Calls `compute(result)`, which rounds to nearest and returns what MPFR functions return, for a result of 53 bits.
template <typename Compute>
double rounded_once(Compute compute) {
  const RangeOfDoubles range;
  MpfrFloat result(std::numeric_limits<double>::digits);
  const int direction = compute(result.get());
  mpfr_subnormalize(result.get(), direction, MPFR_RNDN);
  return mpfr_get_d(result.get(), MPFR_RNDN);
}

Maybe<double> in_range(double value) {
  if (std::isfinite(value)) return value;
  return Undefined{"the result is beyond the range of reals"};
}

template <auto Function>
Maybe<double> value_of(double x) {
  MpfrFloat argument(std::numeric_limits<double>::digits);
  set(argument, x);
  return in_range(rounded_once([&](mpfr_ptr result) { return Function(result, argument.get(), MPFR_RNDN); }));
}

/// As `value_of` for two arguments.
template <auto Function>
Maybe<double> value_of(double x, double y) {
  MpfrFloat first(std::numeric_limits<double>::digits), second(std::numeric_limits<double>::digits);
  set(first, x);
  set(second, y);
  return in_range(
      rounded_once([&](mpfr_ptr result) { return Function(result, first.get(), second.get(), MPFR_RNDN); }));
}

/// The double nearest to a number of many bits; infinite beyond their range.
double nearest(MpfrFloat& exact) {
  return mpfr_get_d(exact.get(), MPFR_RNDN);
}

Undefined outside(double x, const char* text) {
  return Undefined{fmt::format("{} {}", real_text(x), text)};
}

Rational power_of_ten(unsigned long exponent) {
  RationalAccess::Owner power = RationalAccess::make();
  mpz_ui_pow_ui(mpq_numref(power->value), 10, exponent);
  return RationalAccess::take(std::move(power));
}

/// The integer nearest to a positive number, halves up.
Rational nearest_integer(const Rational& number) {
  const Rational raised = number + Rational(1, 2);
  const RationalAccess::View view(raised);
  RationalAccess::Owner whole = RationalAccess::make();
  mpz_fdiv_q(mpq_numref(whole->value), view.numerator(), view.denominator());
  return RationalAccess::take(std::move(whole));
}

}  // namespace

Maybe<double> square_root(double x) {
  if (x < 0) return outside(x, "has no square root");
  return value_of<mpfr_sqrt>(x);
}

Maybe<double> exponential(double x) {
  return value_of<mpfr_exp>(x);
}

Maybe<double> natural_logarithm(double x) {
  if (!(x > 0)) return outside(x, "has no logarithm");
  return value_of<mpfr_log>(x);
}

Maybe<double> logarithm(double x, double base) {
  if (!(x > 0)) return outside(x, "has no logarithm");
  if (!(base > 0) || base == 1) return outside(base, "is not a base of logarithms");
  MpfrFloat numerator(kManyBits), denominator(kManyBits);
  mpfr_log(numerator.get(), set(numerator, x).get(), MPFR_RNDN);
  mpfr_log(denominator.get(), set(denominator, base).get(), MPFR_RNDN);
  mpfr_div(numerator.get(), numerator.get(), denominator.get(), MPFR_RNDN);
  return in_range(nearest(numerator));
}

Maybe<double> power(double base, double exponent) {
  if (base == 0 && exponent < 0) return Undefined{"division by zero"};
  if (base < 0 && exponent != std::trunc(exponent))
    return Undefined{fmt::format("{} has no power with the exponent {}, which is not an integer", real_text(base),
                                 real_text(exponent))};
  return value_of<mpfr_pow>(base, exponent);
}

Maybe<double> sine(double angle_radians) {
  return value_of<mpfr_sin>(angle_radians);
}
Maybe<double> cosine(double angle_radians) {
  return value_of<mpfr_cos>(angle_radians);
}
Maybe<double> tangent(double angle_radians) {
  return value_of<mpfr_tan>(angle_radians);
}

Maybe<double> arc_sine(double x) {
  if (std::abs(x) > 1) return outside(x, "is not a sine of an angle");
  return value_of<mpfr_asin>(x);
}
Maybe<double> arc_cosine(double x) {
  if (std::abs(x) > 1) return outside(x, "is not a cosine of an angle");
  return value_of<mpfr_acos>(x);
}
Maybe<double> arc_tangent(double x) {
  return value_of<mpfr_atan>(x);
}
Maybe<double> arc_tangent_of_quotient(double y, double x) {
  return value_of<mpfr_atan2>(y, x);
}

double degrees_to_radians(double angle_degrees) {
  MpfrFloat angle(kManyBits), pi(kManyBits);
  mpfr_const_pi(pi.get(), MPFR_RNDN);
  mpfr_mul(angle.get(), set(angle, angle_degrees).get(), pi.get(), MPFR_RNDN);
  mpfr_div_ui(angle.get(), angle.get(), 180, MPFR_RNDN);
  return nearest(angle);
}

Maybe<double> radians_to_degrees(double angle_radians) {
  MpfrFloat angle(kManyBits), pi(kManyBits);
  mpfr_const_pi(pi.get(), MPFR_RNDN);
  mpfr_mul_ui(angle.get(), set(angle, angle_radians).get(), 180, MPFR_RNDN);
  mpfr_div(angle.get(), angle.get(), pi.get(), MPFR_RNDN);
  return in_range(nearest(angle));
}

double circle_constant() {
  return rounded_once([](mpfr_ptr result) { return mpfr_const_pi(result, MPFR_RNDN); });
}

double natural_constant() {
  return *exponential(1);
}

Maybe<double> rounded_to_digits(double x, std::int64_t digits) {
  // No double has more digits after the point, or before it.
  constexpr std::int64_t kMostAfter = 1074, kMostBefore = 310;
  if (x == 0 || digits >= kMostAfter) return x;
  const Rational scale = power_of_ten(static_cast<unsigned long>(std::abs(std::max(digits, -kMostBefore))));
  const Rational size = Rational(x).abs();
  const Rational rounded = digits < 0 ? nearest_integer(size / scale) * scale : nearest_integer(size * scale) / scale;
  return in_range(x < 0 ? 0 - rounded.nearest_double() : rounded.nearest_double());
}

}  // namespace algebra3d
