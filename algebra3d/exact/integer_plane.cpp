#include "algebra3d/exact/integer_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <utility>

#include "algebra3d/exact/counters.h"
#include "algebra3d/exact/detail/homogeneous.h"
#include "algebra3d/exact/detail/rational_big.h"

namespace algebra3d {

using detail::ConstantHomogeneous;
using detail::HomogeneousPoint;
using detail::HomogeneousView;

/// The numbers, and doubles that are nearly them: times one power of two, which makes the longest coefficient of the
/// normal about 1.
struct IntegerPlane::Form {
  ConstantHomogeneous numbers;
  std::array<double, 4> rounded{};

  /// Takes the numbers, without a common divisor if they are long.
  static std::shared_ptr<const Form> of(HomogeneousPoint& numbers);
  explicit Form(const HomogeneousPoint& given);
  /// False if the rounded numbers show that the planes are different.
  bool may_equal(const Form& other) const;
};

/// Number of limbs up to which the numbers keep common divisors: that of a plane through doubles.
constexpr std::size_t kLongestUnreducedPlane = 4;

// Smaller coefficients, in terms of the longest one, might lose bits by underflow.
constexpr long kSmallestShift = -900;

std::shared_ptr<const IntegerPlane::Form> IntegerPlane::Form::of(HomogeneousPoint& numbers) {
  detail::shorten(numbers, kLongestUnreducedPlane);
  return std::make_shared<const Form>(numbers);
}

IntegerPlane::Form::Form(const HomogeneousPoint& given) : numbers(given) {
  std::array<double, 4> mantissas{};
  std::array<long, 4> exponents{};
  for (std::size_t i = 0; i < 4; ++i) mantissas[i] = mpz_get_d_2exp(&exponents[i], numbers[i]);
  bool is_in_range = true;  // else an infinite offset leaves all undecided
  const long longest = std::max({exponents[0], exponents[1], exponents[2]});
  for (std::size_t i = 0; i < 4; ++i) {
    const long shift = exponents[i] - longest;
    rounded[i] = std::ldexp(mantissas[i], static_cast<int>(std::clamp(shift, -2000L, 2000L)));
    is_in_range = is_in_range && (mantissas[i] == 0 || shift >= kSmallestShift);
  }
  if (!is_in_range || std::isinf(rounded[3])) rounded[3] = std::numeric_limits<double>::infinity();
}

IntegerPlane IntegerPlane::through(const TriangleRef& triangle) {
  thread_local std::array<HomogeneousPoint, 3> buffers;
  thread_local HomogeneousPoint numbers;
  const auto& [a, b, c] = triangle;
  if (a.is_double() && b.is_double() && c.is_double())
    detail::join(numbers, a.approx, b.approx, c.approx);
  else
    detail::join(numbers, {a, buffers[0]}, {b, buffers[1]}, {c, buffers[2]});
  return IntegerPlane(Form::of(numbers));
}

IntegerPlane IntegerPlane::along_axis(PointRef p, PointRef q, std::size_t axis) {
  thread_local std::array<HomogeneousPoint, 2> buffers;
  thread_local HomogeneousPoint at_infinity;  // of the axis
  for (std::size_t i = 0; i < 4; ++i) mpz_set_ui(at_infinity[i], i == axis ? 1 : 0);
  thread_local HomogeneousPoint numbers;
  detail::join(numbers, {p, buffers[0]}, {q, buffers[1]}, at_infinity);
  return IntegerPlane(Form::of(numbers));
}

IntegerPlane IntegerPlane::of(const ExactPlane& plane) {
  const ExactPlane canonical = plane.canonical();
  const RationalAccess::View offset(canonical.offset);
  thread_local HomogeneousPoint numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const RationalAccess::View component(canonical.normal[axis]);
    mpz_mul(numbers[axis], component.numerator(), offset.denominator());
  }
  mpz_neg(numbers[3], offset.numerator());
  return IntegerPlane(Form::of(numbers));
}

int IntegerPlane::side(const PointRef& point) const {
  detail::count_call();
  const int rounded = detail::filter_rounded_side(form_->rounded, point.approx);
  return rounded != detail::kUndecided ? rounded : side_by_integers(*form_, point);
}

const std::array<double, 4>& IntegerPlane::rounded() const {
  return form_->rounded;
}

int IntegerPlane::side_by_integers(const Form& form, const PointRef& point) {
  detail::count_filter_failure();
  detail::count_big_fallback();
  thread_local HomogeneousPoint buffer;
  thread_local mpz_class sum;
  const HomogeneousView view(point, buffer);
  detail::dot(sum, form.numbers, view);
  return sgn(sum);
}

IntegerPlane IntegerPlane::flipped() const {
  thread_local HomogeneousPoint numbers;
  for (std::size_t i = 0; i < 4; ++i) mpz_neg(numbers[i], form_->numbers[i]);
  return IntegerPlane(std::make_shared<const Form>(numbers));
}

ExactPlane IntegerPlane::exact() const {
  const mpz_class one = 1;
  const auto integer = [&](std::size_t i) { return RationalAccess::quotient(coefficients()[i], one.get_mpz_t()); };
  return {RationalVec3(integer(0), integer(1), integer(2)), -integer(3)};
}

const ConstantHomogeneous& IntegerPlane::coefficients() const {
  return form_->numbers;
}

/// Compares the ratios of the rounded numbers to the longest one of the normal: those of one plane differ by a few
/// roundings at most.
bool IntegerPlane::Form::may_equal(const Form& other) const {
  if (std::isinf(rounded[3]) || std::isinf(other.rounded[3])) return true;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(rounded[i]) > std::abs(rounded[longest])) longest = i;
  for (std::size_t i = 0; i < 4; ++i) {
    const double own = rounded[i] * other.rounded[longest], its = other.rounded[i] * rounded[longest];
    if (std::abs(own - its) > 0x1p-48 * (std::abs(own) + std::abs(its))) return false;
  }
  return true;
}

/// True if the numbers of one are those of the other times a positive factor.
bool operator==(const IntegerPlane& a, const IntegerPlane& b) {
  if (a.form_ == b.form_) return true;
  if (a.is_null() || b.is_null() || !a.form_->may_equal(*b.form_)) return false;
  const ConstantHomogeneous &p = a.coefficients(), &q = b.coefficients();
  const std::size_t axis = mpz_sgn(p[0]) != 0 ? 0 : mpz_sgn(p[1]) != 0 ? 1 : 2;
  if (mpz_sgn(p[axis]) != mpz_sgn(q[axis])) return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (std::is_neq(detail::compare_quotients(p[i], p[axis], q[i], q[axis]))) return false;
  return true;
}

}  // namespace algebra3d
