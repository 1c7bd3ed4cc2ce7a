#include "algebra3d/exact/homogeneous.h"

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

/// a d - b c.
void minor(mpz_ptr result, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d) {
  mpz_mul(result, a, d);
  mpz_submul(result, b, c);
}

}  // namespace

void HomogeneousPoint::set(const PointRef& point) {
  const RationalVec3 doubles = point.is_double() ? RationalVec3(point.approx) : RationalVec3();
  const RationalVec3& exact = point.is_double() ? doubles : *point.exact;
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
