#include "algebra3d/kernel/exact/plane.h"

#include <cmath>
#include <limits>
#include <random>

#include <gmp.h>
#include <gtest/gtest.h>
#include <mpfr.h>

namespace algebra3d {
namespace {

/// Nearest double to d|n| by MPFR, with enough bits for the sum of squares to be exact. No subnormals.
double offset_by_mpfr(double distance, const Vec3& n) {
  mpfr_t sum, square, result;
  mpfr_inits2(9000, sum, square, nullptr);
  mpfr_init2(result, 53);
  mpfr_set_zero(sum, 1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mpfr_set_d(square, n[axis], MPFR_RNDN);
    mpfr_mul_d(square, square, distance, MPFR_RNDN);
    mpfr_sqr(square, square, MPFR_RNDN);
    mpfr_add(sum, sum, square, MPFR_RNDN);
  }
  mpfr_sqrt(result, sum, MPFR_RNDN);
  const double offset = mpfr_get_d(result, MPFR_RNDN);
  mpfr_clears(sum, square, result, nullptr);
  return distance < 0 ? -offset : offset;
}

TEST(Plane, through_a_point_is_exact_and_refuses_a_zero_normal) {
  const auto plane = ExactPlane::through({Rational(1, 3), 2, 0}, {3, 1, 5});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->offset, Rational(3));
  EXPECT_EQ(plane->evaluate({1, 0, 0}), Rational(0));
  EXPECT_EQ(plane->evaluate({1, 0, Rational(1, 10)}), Rational(1, 2));
  EXPECT_FALSE(ExactPlane::through({1, 2, 3}, {0, 0, 0}));
}

TEST(Plane, spanned_by_two_directions_has_the_right_handed_normal) {
  const auto plane = ExactPlane::spanned({0, 0, 7}, {2, 0, 0}, {1, 3, 0});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->normal, RationalVec3(0, 0, 6));
  EXPECT_EQ(plane->offset, Rational(42));
  EXPECT_FALSE(ExactPlane::spanned({0, 0, 7}, {2, 4, 6}, {-1, -2, -3}));
  EXPECT_FALSE(ExactPlane::spanned({0, 0, 7}, {2, 4, 6}, {0, 0, 0}));
}

TEST(Plane, from_distance_takes_the_offset_from_the_normal_s_length) {
  EXPECT_EQ(ExactPlane::from_distance(5, {0, 3, 4})->offset, Rational(25));
  EXPECT_EQ(ExactPlane::from_distance(-5, {0, 3, 4})->offset, Rational(-25));
  EXPECT_EQ(ExactPlane::from_distance(-0.0, {1, 1, 1})->offset, Rational(0));
  EXPECT_EQ(ExactPlane::from_distance(1, {1, 1, 0})->offset, Rational(0x1.6a09e667f3bcdp+0));  // the root of 2
  EXPECT_EQ(ExactPlane::from_distance(1, {1, 1, 0})->normal, RationalVec3(1, 1, 0));
  EXPECT_EQ(ExactPlane::from_distance(1, {5e-324, 0, 0})->offset, Rational(5e-324));
  EXPECT_EQ(ExactPlane::from_distance(0.75, {5e-324, 0, 0})->offset, Rational(5e-324));
  EXPECT_EQ(ExactPlane::from_distance(0.5, {5e-324, 0, 0})->offset, Rational(0));
  EXPECT_EQ(ExactPlane::from_distance(0x1p-100, {3e300, 4e300, 0})->offset, Rational(0x1p-100 * 5e300));
}

TEST(Plane, from_distance_refuses_what_is_no_plane) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ExactPlane::from_distance(1, {0, -0.0, 0}));
  EXPECT_FALSE(ExactPlane::from_distance(1, {1, infinity, 0}));
  EXPECT_FALSE(ExactPlane::from_distance(1, {1, 0, nan}));
  EXPECT_FALSE(ExactPlane::from_distance(infinity, {1, 0, 0}));
  EXPECT_FALSE(ExactPlane::from_distance(nan, {1, 0, 0}));
  EXPECT_FALSE(ExactPlane::from_distance(1e200, {1e200, 0, 0}));
  EXPECT_TRUE(ExactPlane::from_distance(1e-200, {1e300, 0, 0}));
}

TEST(Plane, from_distance_rounds_like_mpfr) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int round = 0; round < 5'000; ++round) {
    const double scale = std::ldexp(1.0, exponent(random));
    const Vec3 normal{unit(random) * scale, std::ldexp(unit(random) * scale, -round % 80), unit(random) * scale};
    const double distance = std::ldexp(unit(random), exponent(random));
    const auto plane = ExactPlane::from_distance(distance, normal);
    ASSERT_TRUE(plane);
    ASSERT_EQ(plane->offset, Rational(offset_by_mpfr(distance, normal)));
  }
}

TEST(Plane, nearest_root_rounds_like_mpfr_for_fractions_and_subnormals) {
  EXPECT_EQ(Rational(0).nearest_root(), 0);
  EXPECT_EQ(Rational(9, 4).nearest_root(), 1.5);
  EXPECT_EQ((Rational(5e-324) * Rational(5e-324)).nearest_root(), 5e-324);
  EXPECT_EQ((Rational(5e-324) * Rational(5e-324) / 4).nearest_root(), 0);
  EXPECT_EQ((Rational(5e-324) * Rational(5e-324) * Rational(9, 4)).nearest_root(), 1e-323);
  EXPECT_EQ((Rational(5e-324) * Rational(5e-324) * Rational(251, 1000)).nearest_root(), 5e-324);
  // Half-way between two doubles: ties to even, and a crumb decides.
  const Rational tie = Rational(1) + Rational(0x1p-53);
  EXPECT_EQ((tie * tie).nearest_root(), 1);
  EXPECT_EQ((tie * tie + Rational(0x1p-400)).nearest_root(), 1 + 0x1p-52);
  std::mt19937_64 random(8);
  mpfr_t exact, root;
  mpq_t square;
  mpfr_init2(exact, 400);
  mpfr_init2(root, 53);
  mpq_init(square);
  for (int round = 0; round < 5'000; ++round) {
    const Rational number(static_cast<std::int64_t>(random() >> (1 + random() % 62)),
                          static_cast<std::int64_t>(random() >> (1 + random() % 50)) + 1);
    mpq_set_str(square, number.text().c_str(), 10);
    mpfr_set_q(exact, square, MPFR_RNDN);
    mpfr_sqrt(root, exact, MPFR_RNDN);
    ASSERT_EQ(number.nearest_root(), mpfr_get_d(root, MPFR_RNDN)) << number.text();
  }
  mpq_clear(square);
  mpfr_clears(exact, root, nullptr);
}

TEST(Plane, canonical_form_is_the_same_for_all_descriptions_of_a_plane) {
  const ExactPlane plane{{Rational(2, 3), 0, Rational(-4, 5)}, Rational(1, 7)};
  const ExactPlane canonical = plane.canonical();
  EXPECT_EQ(canonical.normal, RationalVec3(5, 0, -6));
  EXPECT_EQ(canonical.offset, Rational(15, 14));
  const ExactPlane longer{Rational(22, 13) * plane.normal, Rational(22, 13) * plane.offset};
  EXPECT_EQ(longer.canonical().normal, canonical.normal);
  EXPECT_EQ(longer.canonical().offset, canonical.offset);
  const ExactPlane turned{Rational(-1) * plane.normal, -plane.offset};
  EXPECT_EQ(turned.canonical().normal, RationalVec3(-5, 0, 6));
  EXPECT_EQ(turned.canonical().offset, Rational(-15, 14));
}

TEST(Plane, primitive_direction_has_coprime_integers) {
  EXPECT_EQ(primitive_direction({0, 0, Rational(-7, 9)}), RationalVec3(0, 0, -1));
  EXPECT_EQ(primitive_direction({Rational(1, 2), Rational(1, 3), Rational(-1, 4)}), RationalVec3(6, 4, -3));
  EXPECT_EQ(primitive_direction(RationalVec3(Vec3{5e-324, 1e-323, 0})), RationalVec3(1, 2, 0));
  EXPECT_EQ(primitive_direction({4, 6, 8}), RationalVec3(2, 3, 4));
}

}  // namespace
}  // namespace algebra3d
