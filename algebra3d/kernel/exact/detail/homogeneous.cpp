#include "algebra3d/kernel/exact/detail/homogeneous.h"

#include <algorithm>

#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/detail/exact_sum_integers.h"
#include "algebra3d/kernel/exact/detail/fixed_width.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "algebra3d/kernel/exact/exact_work.h"
#include "base/interruption_scope.h"

namespace algebra3d::detail {
namespace {

constinit thread_local std::uint64_t exact_work = 0;

/// Points of models have numbers of at most so many limbs, points where three planes through doubles meet some eight.
constexpr std::size_t kShort = 16;

std::size_t length_of(const HomogeneousView& numbers) {
  return std::max({mpz_size(numbers[0]), mpz_size(numbers[1]), mpz_size(numbers[2]), mpz_size(numbers[3])});
}

/// Counts the work of a determinant: with n points of s limbs it is some n * n * s * s products of limbs.
template <std::size_t Count>
void count_determinant(const std::array<HomogeneousView, Count>& points) {
  std::uint64_t length = 0;
  for (const HomogeneousView& numbers : points) length += length_of(numbers);
  if (length > Count * kShort) exact_work += length * length;
}

/// a d - b c.
void minor(mpz_ptr result, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
  mpz_mul(result, a, d);
  mpz_submul(result, b, c);
}
void minor(mpz_class& result, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
  minor(result.get_mpz_t(), a, b, c, d);
}

void divide_by_powers_of_two(HomogeneousPoint& numbers) {
  mp_bitcnt_t zeros = mpz_scan1(numbers[0], 0);
  for (std::size_t i = 1; i < 4 && zeros != 0; ++i) zeros = std::min(zeros, mpz_scan1(numbers[i], 0));
  if (zeros == 0) return;
  for (std::size_t i = 0; i < 4; ++i) mpz_tdiv_q_2exp(numbers[i], numbers[i], zeros);
}

}  // namespace

void join(HomogeneousPoint& result, const HomogeneousView& p, const HomogeneousView& q, const HomogeneousView& r) {
  thread_local std::array<std::array<mpz_class, 4>, 4> minors;  // of q and r, by columns i < j
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) minor(minors[i][j], q[i], q[j], r[i], r[j]);
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::array<std::size_t, 3> c{};
    for (std::size_t i = 0; i < 3; ++i) c[i] = i < left_out ? i : i + 1;
    mpz_ptr determinant = result[left_out];
    mpz_mul(determinant, p[c[0]], minors[c[1]][c[2]].get_mpz_t());
    mpz_submul(determinant, p[c[1]], minors[c[0]][c[2]].get_mpz_t());
    mpz_addmul(determinant, p[c[2]], minors[c[0]][c[1]].get_mpz_t());
    if (left_out % 2 == 1) mpz_neg(determinant, determinant);
  }
}

void join(HomogeneousPoint& result, const Vec3& p, const Vec3& q, const Vec3& r) {
  if (join_in_fixed_width(result, {p, q, r})) return;
  BitRange bits;
  for (const Vec3& point : {p, q, r})
    for (std::size_t axis = 0; axis < 3; ++axis) bits.extend(point[axis]);
  const int exponent = std::min(bits.exponent(), 0);
  // With coordinates over one denominator, differences of points are differences of numerators.
  thread_local std::array<mpz_class, 3> origin, u, v;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    set_integer(origin[axis], p[axis], exponent);
    set_integer(u[axis], q[axis], exponent);
    set_integer(v[axis], r[axis], exponent);
    u[axis] -= origin[axis];
    v[axis] -= origin[axis];
  }
  result.w = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
    minor(result[axis], u[j].get_mpz_t(), u[k].get_mpz_t(), v[j].get_mpz_t(), v[k].get_mpz_t());
    mpz_submul(result[3], result[axis], origin[axis].get_mpz_t());
    mpz_mul_2exp(result[axis], result[axis], static_cast<mp_bitcnt_t>(-exponent));
  }
}

void HomogeneousPoint::set_fractions(const std::array<mpz_srcptr, 3>& numerators,
                                     const std::array<mpz_srcptr, 3>& denominators) {
  // The coordinates of a constructed point mostly have one denominator, or one that divides the largest.
  mpz_ptr const divisor = w.get_mpz_t();
  mpz_set(divisor, denominators[0]);
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (mpz_cmp(divisor, denominators[axis]) != 0) mpz_lcm(divisor, divisor, denominators[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mpz_ptr coordinate = (*this)[axis];
    if (mpz_cmp(divisor, denominators[axis]) == 0) {
      mpz_set(coordinate, numerators[axis]);
    } else {
      mpz_divexact(coordinate, divisor, denominators[axis]);
      mpz_mul(coordinate, coordinate, numerators[axis]);
    }
  }
}

void HomogeneousPoint::set(const RationalVec3& point) {
  const RationalAccess::View vx(point.x), vy(point.y), vz(point.z);
  set_fractions({vx.numerator(), vy.numerator(), vz.numerator()},
                {vx.denominator(), vy.denominator(), vz.denominator()});
}

/// Doubles are integers times a power of two.
void HomogeneousPoint::set(const Vec3& doubles) {
  BitRange bits;
  for (std::size_t axis = 0; axis < 3; ++axis) bits.extend(doubles[axis]);
  const int exponent = std::min(bits.exponent(), 0);
  for (std::size_t axis = 0; axis < 3; ++axis) set_integer((*this)[axis], doubles[axis], exponent);
  w = 1;
  w <<= static_cast<mp_bitcnt_t>(-exponent);
}

HomogeneousView::HomogeneousView(const PointRef& point, HomogeneousPoint& buffer) {
  if (point.is_double()) buffer.set(point.approx);
  for (std::size_t i = 0; i < 4; ++i) numbers_[i] = point.is_double() ? IntegerView(buffer[i]) : (*point.exact)[i];
}

PackedIntegers::PackedIntegers(const HomogeneousPoint& numbers) {
  auto* limbs = const_cast<mp_limb_t*>(first_limb());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t size = mpz_size(numbers[i]);
    limbs = std::copy_n(mpz_limbs_read(numbers[i]), size, limbs);
    sizes_[i] = mpz_sgn(numbers[i]) * static_cast<std::int32_t>(size);
  }
}

std::size_t PackedIntegers::bytes_behind(const HomogeneousPoint& numbers) {
  std::size_t limbs = 0;
  for (std::size_t i = 0; i < 4; ++i) limbs += mpz_size(numbers[i]);
  return limbs * sizeof(mp_limb_t);
}

std::size_t PackedIntegers::bytes_behind() const {
  std::size_t limbs = 0;
  for (const std::int32_t size : sizes_) limbs += static_cast<std::size_t>(std::abs(size));
  return limbs * sizeof(mp_limb_t);
}

void shorten(HomogeneousPoint& numbers, std::size_t longest_kept) {
  divide_by_powers_of_two(numbers);
  std::size_t longest = 0;
  for (std::size_t i = 0; i < 4; ++i) longest = std::max(longest, mpz_size(numbers[i]));
  if (longest <= longest_kept) return;
  thread_local mpz_class divisor;
  mpz_gcd(divisor.get_mpz_t(), numbers[0], numbers[1]);
  for (std::size_t i = 2; i < 4; ++i)
    if (divisor != 1) mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), numbers[i]);
  if (divisor == 1) return;
  for (std::size_t i = 0; i < 4; ++i) mpz_divexact(numbers[i], numbers[i], divisor.get_mpz_t());
}

void dot(mpz_class& result, const HomogeneousView& a, const HomogeneousView& b) {
  if (length_of(b) > kShort) exact_work += std::uint64_t{4} * length_of(a) * length_of(b);
  mpz_mul(result.get_mpz_t(), a[0], b[0]);
  for (std::size_t i = 1; i < 4; ++i) mpz_addmul(result.get_mpz_t(), a[i], b[i]);
}

std::strong_ordering compare_quotients(mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
  poll_interruption();
  thread_local mpz_class one, other;
  if (mpz_size(a) > kShort) exact_work += std::uint64_t{2} * mpz_size(a) * mpz_size(d);
  mpz_mul(one.get_mpz_t(), a, d);
  mpz_mul(other.get_mpz_t(), c, b);
  return cmp(one, other) <=> 0;
}

int orient3d_by_integers(const std::array<const PointRef*, 4>& points) {
  thread_local std::array<HomogeneousPoint, 4> buffers;
  thread_local mpz_class upper, lower, sum;
  const std::array<HomogeneousView, 4> p{
      {{*points[0], buffers[0]}, {*points[1], buffers[1]}, {*points[2], buffers[2]}, {*points[3], buffers[3]}}};
  count_determinant(p);
  // Expansion of the 4 x 4 determinant by pairs of rows (Laplace): rows 0, 1 in two columns, rows 2, 3 in the others.
  constexpr std::array<std::array<std::size_t, 4>, 6> kColumns{
      {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
  sum = 0;
  for (const auto& [i, j, k, l] : kColumns) {
    minor(upper, p[0][i], p[0][j], p[1][i], p[1][j]);
    minor(lower, p[2][k], p[2][l], p[3][k], p[3][l]);
    mpz_addmul(sum.get_mpz_t(), upper.get_mpz_t(), lower.get_mpz_t());
  }
  // orient3d is the determinant of differences to the first point, which is minus that of the rows (x y z 1).
  return -sgn(sum);
}

int orient2d_by_integers(Projection plane, const std::array<const PointRef*, 3>& points) {
  thread_local std::array<HomogeneousPoint, 3> buffers;
  thread_local mpz_class part, sum;
  const std::array<HomogeneousView, 3> p{
      {{*points[0], buffers[0]}, {*points[1], buffers[1]}, {*points[2], buffers[2]}}};
  count_determinant(p);
  const std::size_t x = first_axis(plane), y = second_axis(plane), w = 3;
  sum = 0;
  for (std::size_t row = 0; row < 3; ++row) {
    const HomogeneousView &a = p[row], &b = p[(row + 1) % 3], &c = p[(row + 2) % 3];
    minor(part, b[x], b[y], c[x], c[y]);
    mpz_addmul(sum.get_mpz_t(), a[w], part.get_mpz_t());
  }
  return sgn(sum);
}

}  // namespace algebra3d::detail

namespace algebra3d {

std::uint64_t exact_work_of_this_thread() {
  return detail::exact_work;
}

}  // namespace algebra3d
