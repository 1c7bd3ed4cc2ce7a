#include "algebra3d/kernel/planar/polygon_measures.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <random>

#include "support/plane_shapes.h"

namespace algebra3d {
namespace {

using namespace plane_shapes;

TEST(PolygonMeasures, of_simple_shapes) {
  const Polygons polygons = polygons_of({{reversed(box(0, 0, 4, 4)), box(1, 1, 2, 2)}, {box(5, 5, 8, 9)}});
  EXPECT_EQ(doubled_area(polygons), Rational(54));
  EXPECT_EQ(nearest_area(polygons), 27);
  EXPECT_EQ(nearest_perimeter(polygons), 16 + 4 + 14);
  EXPECT_EQ(doubled_area(Polygons()), Rational(0));
  EXPECT_EQ(nearest_perimeter(Polygons()), 0);
}

TEST(PolygonMeasures, of_rationals) {
  Polygons polygons;
  for (const auto& [x, y] : std::vector<std::pair<Rational, Rational>>{
           {Rational(0), Rational(0)}, {Rational(1, 3), Rational(0)}, {Rational(1, 3), Rational(1, 4)}})
    polygons.corners.push_back(ExactPoint(RationalVec3(x, y, Rational())));
  polygons.cycle_ends = {3};
  polygons.face_ends = {1};
  EXPECT_EQ(doubled_area(polygons), Rational(1, 12));
  EXPECT_DOUBLE_EQ(nearest_perimeter(polygons), 1);
}

TEST(PolygonMeasures, of_any_size) {
  for (const double scale : {0x1p-1070, 0x1p-500, 0x1p-30, 0x1p30, 0x1p500, 0x1p1000}) {
    const Polygons polygons = polygons_of({{{{0, 0, 0}, {3 * scale, 0, 0}, {3 * scale, 4 * scale, 0}}}});
    EXPECT_EQ(nearest_perimeter(polygons), 12 * scale);
    EXPECT_EQ(doubled_area(polygons), Rational(12) * Rational(scale) * Rational(scale));
  }
  const double huge = 0x1.8p1023;
  EXPECT_TRUE(std::isinf(nearest_perimeter(polygons_of({{box(-huge, -huge, huge, huge)}}))));
  EXPECT_TRUE(std::isinf(nearest_area(polygons_of({{box(-huge, -huge, huge, huge)}}))));
}

/// Coordinates whose bits lie far apart; the oracle is a sum of rationals.
TEST(PolygonMeasures, area_of_wide_ranges_is_exact) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  for (const int width : {0, 50, 100, 1000}) {
    Cycle cycle;
    for (int i = 0; i < 50; ++i)
      cycle.push_back(
          {std::ldexp(std::uniform_real_distribution<double>(-1, 1)(random), -static_cast<int>(random() % (width + 1))),
           std::ldexp(std::uniform_real_distribution<double>(-1, 1)(random), -static_cast<int>(random() % (width + 1))),
           0});
    Rational sum;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const RationalVec3 a(cycle[i]), b(cycle[(i + 1) % cycle.size()]);
      sum += a.x * b.y - b.x * a.y;
    }
    EXPECT_EQ(doubled_area(polygons_of({{cycle}})), sum.abs());
  }
}

TEST(PolygonMeasures, perimeter_is_right_to_2_ulp) {
  std::mt19937_64 random(2);  // NOLINT(cert-msc51-cpp): the same in every run
  for (const double shift : {0.0, 1e9}) {
    const Polygons polygons =
        polygons_of({{shaken(star(2000, 0.1, 1, random), shift, random)}, {star(1000, 0.9, 1e-3, random)}});
    mpfr_t sum, x, y;
    mpfr_inits2(400, sum, x, y, nullptr);
    mpfr_set_zero(sum, 1);
    for (std::size_t cycle = 0; cycle < 2; ++cycle) {
      const std::uint32_t begin = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
      for (std::uint32_t i = begin; i < end; ++i) {
        const Vec3 a = polygons.corners.approx()[i], b = polygons.corners.approx()[i + 1 == end ? begin : i + 1];
        mpfr_set_d(x, b.x, MPFR_RNDN);
        mpfr_sub_d(x, x, a.x, MPFR_RNDN);
        mpfr_set_d(y, b.y, MPFR_RNDN);
        mpfr_sub_d(y, y, a.y, MPFR_RNDN);
        mpfr_hypot(x, x, y, MPFR_RNDN);
        mpfr_add(sum, sum, x, MPFR_RNDN);
      }
    }
    const double expected = mpfr_get_d(sum, MPFR_RNDN), ulp = std::nextafter(expected, 1e300) - expected;
    EXPECT_LE(std::abs(nearest_perimeter(polygons) - expected), 2 * ulp);
    mpfr_clears(sum, x, y, nullptr);
  }
}

}  // namespace
}  // namespace algebra3d
