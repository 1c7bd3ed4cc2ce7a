#include "algebra3d/exact/integer_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra3d/exact/counters.h"
#include "algebra3d/exact/detail/homogeneous.h"
#include "algebra3d/exact/detail/rational_big.h"

namespace algebra3d {

using detail::HomogeneousPoint;
using detail::HomogeneousView;

/// The numbers, and doubles that are nearly them: times one power of two, which makes the longest coefficient of the
/// normal about 1.
struct IntegerPlane::Form {
  HomogeneousPoint numbers;
  std::array<double, 4> rounded{};

  void finish();
  /// detail::kUndecided if that needs the integers.
  int rounded_side(const Vec3& point) const;
};

// Smaller coefficients, in terms of the longest one, might lose bits by underflow.
constexpr long kSmallestShift = -900;

void IntegerPlane::Form::finish() {
  detail::divide_by_common_divisor(numbers);
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
  // Of one sign, so that equal planes have equal numbers however they came about.
  if (!is_in_range || std::isinf(rounded[3])) rounded[3] = std::numeric_limits<double>::infinity();
}

IntegerPlane IntegerPlane::through(const TriangleRef& triangle) {
  thread_local std::array<HomogeneousPoint, 3> buffers;
  const auto form = std::make_shared<Form>();
  const auto& [a, b, c] = triangle;
  if (a.is_double() && b.is_double() && c.is_double())
    detail::join(form->numbers, a.approx, b.approx, c.approx);
  else
    detail::join(form->numbers, {a, buffers[0]}, {b, buffers[1]}, {c, buffers[2]});
  form->finish();
  return IntegerPlane(form);
}

IntegerPlane IntegerPlane::along_axis(PointRef p, PointRef q, std::size_t axis) {
  thread_local std::array<HomogeneousPoint, 2> buffers;
  thread_local HomogeneousPoint at_infinity;  // of the axis
  for (std::size_t i = 0; i < 4; ++i) mpz_set_ui(at_infinity[i], i == axis ? 1 : 0);
  const auto form = std::make_shared<Form>();
  detail::join(form->numbers, {p, buffers[0]}, {q, buffers[1]}, at_infinity);
  form->finish();
  return IntegerPlane(form);
}

IntegerPlane IntegerPlane::of(const ExactPlane& plane) {
  const ExactPlane canonical = plane.canonical();
  const RationalAccess::View offset(canonical.offset);
  const auto form = std::make_shared<Form>();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const RationalAccess::View component(canonical.normal[axis]);
    mpz_mul(form->numbers[axis], component.numerator(), offset.denominator());
  }
  mpz_neg(form->numbers[3], offset.numerator());
  form->finish();
  return IntegerPlane(form);
}

int IntegerPlane::Form::rounded_side(const Vec3& p) const {
  const auto& [a, b, c, d] = rounded;
  const double x = a * p.x, y = b * p.y, z = c * p.z;
  const double height = x + y + z + d;
  // Coefficients were cut off by less than 2^-52 of each, coordinates rounded by 2^-53; three products and sums by as
  // much each: less than nine times 2^-53 of all terms together. What underflow takes is less than 2^-1000.
  const double error = 0x1.4p-50 * (std::abs(x) + std::abs(y) + std::abs(z) + std::abs(d)) + 0x1p-1000;
  if (height > error) return 1;
  if (height < -error) return -1;
  return detail::kUndecided;
}

int IntegerPlane::side(const PointRef& point) const {
  detail::count_call();
  const int rounded = form_->rounded_side(point.approx);
  return rounded != detail::kUndecided ? rounded : side_by_integers(*form_, point);
}

int IntegerPlane::rounded_side(const Vec3& point) const {
  return form_->rounded_side(point);
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
  const auto form = std::make_shared<Form>();
  for (std::size_t i = 0; i < 4; ++i) {
    mpz_neg(form->numbers[i], form_->numbers[i]);
    // An infinite offset stands for one that no double tells, and has one sign in all planes.
    form->rounded[i] = std::isinf(form_->rounded[i]) ? form_->rounded[i] : -form_->rounded[i];
  }
  return IntegerPlane(form);
}

ExactPlane IntegerPlane::exact() const {
  const mpz_class one = 1;
  const auto integer = [&](std::size_t i) { return RationalAccess::quotient(coefficients()[i], one.get_mpz_t()); };
  return {RationalVec3(integer(0), integer(1), integer(2)), -integer(3)};
}

const HomogeneousPoint& IntegerPlane::coefficients() const {
  return form_->numbers;
}

bool operator==(const IntegerPlane& a, const IntegerPlane& b) {
  if (a.form_ == b.form_) return true;
  if (a.is_null() || b.is_null() || a.form_->rounded != b.form_->rounded) return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (mpz_cmp(a.coefficients()[i], b.coefficients()[i]) != 0) return false;
  return true;
}

}  // namespace algebra3d
