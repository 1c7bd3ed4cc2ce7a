#include "algebra3d/kernel/exact/detail/exact_coordinates.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <new>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

using detail::HomogeneousPoint;

/// Number of limbs up to which the integers keep common divisors: that of the common point of three planes through
/// doubles.
constexpr std::size_t kLongestUnreducedPoint = 7;

void make_denominator_positive(HomogeneousPoint& numbers) {
  if (sgn(numbers.w) > 0) return;
  for (std::size_t i = 0; i < 4; ++i) mpz_neg(numbers[i], numbers[i]);
}

}  // namespace

ExactCoordinates::ExactCoordinates(const HomogeneousPoint& numbers, const std::array<std::int8_t, 3>& beyond)
    : beyond_(beyond), numbers_(numbers) {}

const ExactCoordinates* ExactCoordinates::allocate(const HomogeneousPoint& numbers,
                                                   const std::array<std::int8_t, 3>& beyond) {
  static_assert(sizeof(ExactCoordinates) % alignof(mp_limb_t) == 0);
  detail::count_heap_rational();
  void* block = ::operator new(sizeof(ExactCoordinates) + detail::PackedIntegers::bytes_behind(numbers));
  return new (block) ExactCoordinates(numbers, beyond);
}

SharedCoordinates ExactCoordinates::make(HomogeneousPoint& numbers, Vec3& approx) {
  poll_interruption();
  detail::shorten(numbers, kLongestUnreducedPoint);
  make_denominator_positive(numbers);
  std::array<std::int8_t, 3> beyond{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const RoundedQuotient rounded = round_quotient(numbers[axis], numbers[3]);
    approx[axis] = rounded.value;
    beyond[axis] = static_cast<std::int8_t>(rounded.beyond);
  }
  if (std::ranges::all_of(beyond, [](int sign) { return sign == 0; })) return {};
  return SharedCoordinates(allocate(numbers, beyond));
}

Rational ExactCoordinates::coordinate(std::size_t axis) const {
  return RationalAccess::quotient(numbers_[axis], numbers_[3]);
}

double ExactCoordinates::rest(std::size_t axis, double rounded) const {
  if (beyond_[axis] == 0) return 0;
  const double known = rests_[axis].load(std::memory_order_relaxed);
  if (!std::isnan(known)) return known;
  const double computed = compute_rest(axis, rounded);
  rests_[axis].store(computed, std::memory_order_relaxed);
  return computed;
}

/// (X - m W) / W, where the rounding m is an integer times a power of two.
double ExactCoordinates::compute_rest(std::size_t axis, double rounded) const {
  thread_local mpz_class difference, product;
  constexpr int kBits = std::numeric_limits<double>::digits;
  int exponent = 0;
  const double mantissa = std::frexp(rounded, &exponent);
  exponent -= kBits;
  mpz_mul_si(product.get_mpz_t(), numbers_[3], static_cast<long>(std::ldexp(mantissa, kBits)));
  const auto shift = static_cast<mp_bitcnt_t>(std::abs(exponent));
  if (exponent >= 0) {
    mpz_mul_2exp(product.get_mpz_t(), product.get_mpz_t(), shift);
    mpz_sub(difference.get_mpz_t(), numbers_[axis], product.get_mpz_t());
  } else {
    mpz_mul_2exp(difference.get_mpz_t(), numbers_[axis], shift);
    mpz_sub(difference.get_mpz_t(), difference.get_mpz_t(), product.get_mpz_t());
  }
  long difference_exponent = 0, divisor_exponent = 0;
  const double dividend = mpz_get_d_2exp(&difference_exponent, difference.get_mpz_t());
  const double divisor = mpz_get_d_2exp(&divisor_exponent, numbers_[3]);
  return std::ldexp(dividend / divisor,
                    static_cast<int>(difference_exponent - divisor_exponent + std::min(exponent, 0)));
}

std::size_t ExactCoordinates::heap_bytes() const {
  return sizeof(ExactCoordinates) + numbers_.bytes_behind();
}

bool operator==(const ExactCoordinates& a, const ExactCoordinates& b) {
  if (&a == &b) return true;
  poll_interruption();
  if (a.beyond_ != b.beyond_) return false;
  const bool have_one_denominator = mpz_cmp(a[3], b[3]) == 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool is_equal = have_one_denominator ? mpz_cmp(a[axis], b[axis]) == 0
                                               : std::is_eq(detail::compare_quotients(a[axis], a[3], b[axis], b[3]));
    if (!is_equal) return false;
  }
  return true;
}

void add_owner(const ExactCoordinates& coordinates) noexcept {
  coordinates.owners_.add();
}

void remove_owner(const ExactCoordinates& coordinates) noexcept {
  if (!coordinates.owners_.remove()) return;
  coordinates.~ExactCoordinates();
  ::operator delete(const_cast<ExactCoordinates*>(&coordinates));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

}  // namespace algebra3d
