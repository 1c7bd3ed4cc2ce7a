#include "algebra3d/kernel/exact/trigonometry.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "algebra3d/kernel/exact/detail/mpfr_float.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"

namespace algebra3d {

namespace {

constexpr mpfr_prec_t kWorkingBits = 128;

/// The angle of the same direction in (-180, 180]. Exact: the remainder is, and so is the difference of doubles within
/// a factor of two.
double reduce_by_turns(double angle_degrees) {
  const double rest = std::fmod(angle_degrees, 360.0);
  if (rest > 180) return rest - 360;
  if (rest <= -180) return rest + 360;
  return rest;
}

/// tan(angle / 2) / sqrt(squared_length), with a relative error below 2^-125: three roundings.
Rational tangent_ratio(double angle_degrees, const Rational& squared_length) {
  MpfrFloat length(kWorkingBits);
  mpfr_set_q(length.get(), RationalAccess::View(squared_length).get(), MPFR_RNDN);
  mpfr_sqrt(length.get(), length.get(), MPFR_RNDN);
  MpfrFloat tangent(kWorkingBits);
  mpfr_set_d(tangent.get(), angle_degrees, MPFR_RNDN);
  mpfr_tanu(tangent.get(), tangent.get(), 720, MPFR_RNDN);  // the argument is in units of which 720 make a turn
  mpfr_div(tangent.get(), tangent.get(), length.get(), MPFR_RNDN);
  RationalAccess::Owner exact = RationalAccess::make();
  mpfr_get_q(exact->value, tangent.get());
  return RationalAccess::take(std::move(exact));
}

Rational floor_of(const Rational& number) {
  const RationalAccess::View view(number);
  RationalAccess::Owner floor = RationalAccess::make();
  mpz_fdiv_q(mpq_numref(floor->value), view.numerator(), view.denominator());
  return RationalAccess::take(std::move(floor));
}

}  // namespace

// Error of the angle: the map ln t -> 2 atan t has the slope 2t / (1 + t^2) <= 1. So an error of the angle's
// half-tangent by a factor 1 + d, whatever its size, turns the angle by at most |ln(1 + d)|. Here |d| < 2^-51 + 2^-124,
// from the width of the interval and the error of its middle, and |ln(1 + d)| < 2^-50. The relative bound also keeps
// tiny angles from becoming zero and angles near a half turn from becoming one.
//
// Exactness: if the true number is p/q, another fraction with a denominator up to q differs from it by at least 1/q^2,
// relative to it by 1/(pq); for p, q <= 2^24 that lies outside the interval, so p/q is the simplest one in it.
std::optional<Rational> half_angle_ratio(double angle_degrees, const Rational& squared_length) {
  assert(std::isfinite(angle_degrees) && squared_length.sign() > 0);
  const double angle = reduce_by_turns(angle_degrees);
  if (angle == 180) return std::nullopt;
  if (angle == 0) return Rational();
  const Rational middle = tangent_ratio(std::abs(angle), squared_length);
  const Rational margin = middle * Rational(0x1p-51);
  const Rational ratio = simplest_between(middle - margin, middle + margin);
  return angle < 0 ? -ratio : ratio;
}

// Walks down the continued fraction that the ends of the interval share; the first partial quotient with an integer in
// between ends it. Invariant: the fraction is (p x + p_before) / (q x + q_before) with x to be chosen in [low, high].
Rational simplest_between(const Rational& low, const Rational& high) {
  assert(low.sign() > 0 && low <= high);
  Rational from = low;
  Rational to = high;
  Rational p = 1, p_before = 0;
  Rational q = 0, q_before = 1;
  for (;;) {
    const Rational whole = floor_of(from);
    const bool ends = whole == from || whole + 1 <= to;
    const Rational quotient = ends && whole != from ? whole + 1 : whole;
    p_before = std::exchange(p, quotient * p + p_before);
    q_before = std::exchange(q, quotient * q + q_before);
    if (ends) return p / q;
    // Both ends have this integer part and a fraction; taking the inverse swaps them.
    Rational next = Rational(1) / (to - whole);
    to = Rational(1) / (from - whole);
    from = std::move(next);
  }
}

CirclePoint circle_point(std::uint32_t index, std::uint32_t count) {
  assert(count > 0);
  MpfrFloat angle(64);
  MpfrFloat coordinate(53);
  mpfr_set_ui(angle.get(), index % count, MPFR_RNDN);
  mpfr_cosu(coordinate.get(), angle.get(), count, MPFR_RNDN);
  const double cosine = mpfr_get_d(coordinate.get(), MPFR_RNDN);
  mpfr_sinu(coordinate.get(), angle.get(), count, MPFR_RNDN);
  return {cosine + 0.0, mpfr_get_d(coordinate.get(), MPFR_RNDN) + 0.0};  // no negative zero
}

}  // namespace algebra3d
