#include "algebra3d/kernel/exact/integer_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "base/interruption_scope.h"
#include "base/reference_count.h"

namespace algebra3d {

using detail::HomogeneousPoint;
using detail::HomogeneousView;
using detail::PackedIntegers;

/// The numbers, and doubles that are nearly them: times one power of two, which makes the longest coefficient of the
/// normal about 1. In one heap block.
struct IntegerPlane::Form {
  mutable ReferenceCount<std::uint32_t> owners{0};
  std::array<double, 4> rounded{};
  PackedIntegers numbers;  // last: the limbs follow this object

  /// The plane with these numbers, which are not kept if they have common divisors.
  static IntegerPlane plane(HomogeneousPoint& numbers);
  explicit Form(const HomogeneousPoint& given);
  /// False if the rounded numbers show that the planes are different, whichever way each is turned.
  bool may_equal(const Form& other) const;
};

void add_owner(const IntegerPlane::Form& form) noexcept {
  form.owners.add();
}

void remove_owner(const IntegerPlane::Form& form) noexcept {
  using Form = IntegerPlane::Form;
  if (!form.owners.remove()) return;
  form.~Form();
  ::operator delete(const_cast<Form*>(&form));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

/// Number of limbs up to which the numbers keep common divisors: that of a plane through doubles.
constexpr std::size_t kLongestUnreducedPlane = 4;

// Smaller coefficients, in terms of the longest one, might lose bits by underflow.
constexpr long kSmallestShift = -900;

IntegerPlane IntegerPlane::Form::plane(HomogeneousPoint& numbers) {
  detail::shorten(numbers, kLongestUnreducedPlane);
  static_assert(sizeof(Form) % alignof(mp_limb_t) == 0);
  void* block = ::operator new(sizeof(Form) + PackedIntegers::bytes_behind(numbers));
  return {SharedForm(new (block) Form(numbers)), false};
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
  return Form::plane(numbers);
}

IntegerPlane IntegerPlane::along_axis(PointRef p, PointRef q, std::size_t axis) {
  thread_local std::array<HomogeneousPoint, 2> buffers;
  thread_local HomogeneousPoint at_infinity;  // of the axis
  for (std::size_t i = 0; i < 4; ++i) mpz_set_ui(at_infinity[i], i == axis ? 1 : 0);
  thread_local HomogeneousPoint numbers;
  detail::join(numbers, {p, buffers[0]}, {q, buffers[1]}, at_infinity);
  return Form::plane(numbers);
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
  return Form::plane(numbers);
}

int IntegerPlane::side(const PointRef& point) const {
  detail::count_call();
  poll_interruption();
  const int rounded = detail::filter_rounded_side(form_.get()->rounded, point.approx);
  if (rounded == detail::kUndecided) return side_by_integers(point);
  return is_flipped_ ? -rounded : rounded;
}

std::array<double, 4> IntegerPlane::rounded() const {
  std::array<double, 4> numbers = form_.get()->rounded;
  if (is_flipped_)
    for (double& number : numbers) number = -number;
  return numbers;
}

int IntegerPlane::side_by_integers(const PointRef& point) const {
  detail::count_filter_failure();
  detail::count_big_fallback();
  thread_local HomogeneousPoint buffer;
  thread_local mpz_class sum;
  const HomogeneousView view(point, buffer);
  detail::dot(sum, coefficients(), view);
  return sgn(sum);
}

ExactPlane IntegerPlane::exact() const {
  const mpz_class one = 1;
  const HomogeneousView numbers = coefficients();
  const auto integer = [&](std::size_t i) { return RationalAccess::quotient(numbers[i], one.get_mpz_t()); };
  return {RationalVec3(integer(0), integer(1), integer(2)), -integer(3)};
}

HomogeneousView IntegerPlane::coefficients() const {
  const PackedIntegers& numbers = form_.get()->numbers;
  if (is_flipped_) return HomogeneousView({-numbers[0], -numbers[1], -numbers[2], -numbers[3]});
  return HomogeneousView({numbers[0], numbers[1], numbers[2], numbers[3]});
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
  if (a.form_.get() == b.form_.get()) return a.is_null() || a.is_flipped_ == b.is_flipped_;
  if (a.is_null() || b.is_null() || !a.form_.get()->may_equal(*b.form_.get())) return false;
  const HomogeneousView p = a.coefficients(), q = b.coefficients();
  const std::size_t axis = mpz_sgn(p[0]) != 0 ? 0 : mpz_sgn(p[1]) != 0 ? 1 : 2;
  if (mpz_sgn(p[axis]) != mpz_sgn(q[axis])) return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (std::is_neq(detail::compare_quotients(p[i], p[axis], q[i], q[axis]))) return false;
  return true;
}

}  // namespace algebra3d
