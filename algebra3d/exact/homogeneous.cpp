#include "algebra3d/exact/homogeneous.h"

#include <algorithm>

#include "algebra3d/exact/exact_sum_integers.h"
#include "algebra3d/exact/rational_big.h"

namespace algebra3d::detail {
namespace {

/// Brings three fractions to one denominator.
void set_from_fractions(HomogeneousPoint& point, const std::array<mpz_srcptr, 3>& numerators,
                        const std::array<mpz_srcptr, 3>& denominators) {
  const std::array<mpz_ptr, 3> coordinates{point.x, point.y, point.z};
  // The coordinates of a constructed point mostly have one denominator, or one that divides the largest.
  mpz_set(point.w, denominators[0]);
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (mpz_cmp(point.w, denominators[axis]) != 0) mpz_lcm(point.w, point.w, denominators[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (mpz_cmp(point.w, denominators[axis]) == 0) {
      mpz_set(coordinates[axis], numerators[axis]);
    } else {
      mpz_divexact(coordinates[axis], point.w, denominators[axis]);
      mpz_mul(coordinates[axis], coordinates[axis], numerators[axis]);
    }
  }
}

/// Doubles are integers times a power of two.
void set_from_doubles(HomogeneousPoint& point, const Vec3& doubles) {
  BitRange bits;
  for (std::size_t axis = 0; axis < 3; ++axis) bits.extend(doubles[axis]);
  const int exponent = std::min(bits.exponent(), 0);
  for (std::size_t axis = 0; axis < 3; ++axis) set_integer(point[axis], doubles[axis], exponent);
  mpz_set_ui(point.w, 1);
  mpz_mul_2exp(point.w, point.w, static_cast<mp_bitcnt_t>(-exponent));
}

/// a d - b c.
void minor(mpz_ptr result, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
  mpz_mul(result, a, d);
  mpz_submul(result, b, c);
}

}  // namespace

void join(HomogeneousPoint& result, const HomogeneousPoint& p, const HomogeneousPoint& q, const HomogeneousPoint& r) {
  thread_local std::array<std::array<BigInteger, 4>, 4> minors;  // of q and r, by columns i < j
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) minor(minors[i][j], q[i], q[j], r[i], r[j]);
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::array<std::size_t, 3> c{};
    for (std::size_t i = 0; i < 3; ++i) c[i] = i < left_out ? i : i + 1;
    mpz_ptr determinant = result[left_out];
    mpz_mul(determinant, p[c[0]], minors[c[1]][c[2]]);
    mpz_submul(determinant, p[c[1]], minors[c[0]][c[2]]);
    mpz_addmul(determinant, p[c[2]], minors[c[0]][c[1]]);
    if (left_out % 2 == 1) mpz_neg(determinant, determinant);
  }
}

void HomogeneousPoint::set(const PointRef& point) {
  if (point.is_double()) {
    set_from_doubles(*this, point.approx);
    return;
  }
  const RationalVec3& exact = *point.exact;
  const RationalAccess::View vx(exact.x), vy(exact.y), vz(exact.z);
  set_from_fractions(*this, {vx.numerator(), vy.numerator(), vz.numerator()},
                     {vx.denominator(), vy.denominator(), vz.denominator()});
}

int orient3d_by_integers(const std::array<const PointRef*, 4>& points) {
  thread_local std::array<HomogeneousPoint, 4> p;
  thread_local BigInteger upper, lower, sum;
  for (std::size_t i = 0; i < 4; ++i) p[i].set(*points[i]);
  // Expansion of the 4 x 4 determinant by pairs of rows (Laplace): rows 0, 1 in two columns, rows 2, 3 in the others.
  constexpr std::array<std::array<std::size_t, 4>, 6> kColumns{
      {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
  mpz_set_ui(sum, 0);
  for (const auto& [i, j, k, l] : kColumns) {
    minor(upper, p[0][i], p[0][j], p[1][i], p[1][j]);
    minor(lower, p[2][k], p[2][l], p[3][k], p[3][l]);
    mpz_addmul(sum, upper, lower);
  }
  // orient3d is the determinant of differences to the first point, which is minus that of the rows (x y z 1).
  return -sum.sign();
}

int orient2d_by_integers(Projection plane, const std::array<const PointRef*, 3>& points) {
  thread_local std::array<HomogeneousPoint, 3> p;
  thread_local BigInteger part, sum;
  for (std::size_t i = 0; i < 3; ++i) p[i].set(*points[i]);
  const std::size_t x = first_axis(plane), y = second_axis(plane), w = 3;
  mpz_set_ui(sum, 0);
  for (std::size_t row = 0; row < 3; ++row) {
    const HomogeneousPoint &a = p[row], &b = p[(row + 1) % 3], &c = p[(row + 2) % 3];
    minor(part, b[x], b[y], c[x], c[y]);
    mpz_addmul(sum, a[w], part);
  }
  return sum.sign();
}

}  // namespace algebra3d::detail
