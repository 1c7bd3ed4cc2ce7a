#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "unit/operators/call_operator.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using calls::call;
using calls::cube;
using calls::point;

/// The volume and moments term by term in rationals, as the formula has them.
SolidMoments moments_by_rationals(const TriangleMesh& mesh) {
  SolidMoments result;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    const RationalVec3 a = t[0].rational(), b = t[1].rational(), c = t[2].rational();
    const Rational determinant = dot(a, cross(b, c));
    result.volume += determinant / Rational(6);
    result.first = result.first + (determinant / Rational(24)) * (a + b + c);
  }
  return result;
}

void expect_moments_as_by_rationals(const TriangleMesh& mesh) {
  const SolidMoments expected = moments_by_rationals(mesh);
  const auto triangles = triangles_of(mesh);
  EXPECT_EQ(*exact_volume(mesh.points(), triangles), expected.volume);
  const auto moments = exact_moments(mesh.points(), triangles);
  EXPECT_EQ(moments->volume, expected.volume);
  EXPECT_EQ(moments->first, expected.first);
}

TriangleMesh random_triangles(double smallest_exponent, double largest_exponent, bool floats, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(smallest_exponent, largest_exponent), unit(-1, 1);
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto number = [&] {
    const double x = unit(random) * std::exp2(exponent(random));
    return floats ? static_cast<double>(static_cast<float>(x)) : x;
  };
  for (std::uint32_t i = 0; i < 60; ++i) points.push_back({number(), number(), number()});
  for (std::uint32_t i = 0; i + 2 < 60; ++i) triangles.push_back({i, i + 1, i + 2});
  return {PointArray(std::move(points)), triangles};
}

TEST(Volume, sums_agree_with_rationals_for_floats_of_like_size) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) expect_moments_as_by_rationals(random_triangles(0, 5, true, seed));
}

TEST(Volume, sums_agree_with_rationals_for_doubles_of_unlike_size) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    expect_moments_as_by_rationals(random_triangles(-20, 20, false, seed));
    expect_moments_as_by_rationals(random_triangles(-300, 300, false, seed));
  }
  expect_moments_as_by_rationals(random_triangles(-1080, 1000, false, 1));
}

TEST(Volume, sums_agree_with_rationals_for_coordinates_that_are_no_doubles) {
  expect_moments_as_by_rationals(samples::MeshMaker(Rational(1, 3), Rational(1, 7)).box({0, 0, 0}, {1, 2, 3}).mesh());
  // Only some corners are not doubles.
  expect_moments_as_by_rationals(samples::MeshMaker(Rational(1, 3)).box({0, 0, 0}, {1, 3, 6}).mesh());
}

/// Corners that are not doubles: some of those of a mesh of doubles are divided by an odd number.
TriangleMesh with_fractions(const TriangleMesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  PointArray points;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const RationalVec3 place = mesh.points()[v].rational();
    const auto divisor = static_cast<std::int64_t>(2 * (random() % 4) + 1);
    points.push_back(ExactPoint(Rational(1, divisor) * place));
  }
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) triangles.push_back(mesh.triangle(FaceId(f)));
  return {std::move(points), triangles};
}

/// Volume and centroid rounded, beside the sums of rationals. Returns how often rounding needed these sums.
std::uint64_t expect_nearest_as_by_rationals(const TriangleMesh& mesh) {
  const SolidMoments expected = moments_by_rationals(mesh);
  reset_exact_counters();
  EXPECT_EQ(*nearest_volume(mesh.points(), triangles_of(mesh)), expected.volume.nearest_double());
  const Vec3 centroid = *nearest_centroid(mesh.points(), triangles_of(mesh));
  const std::uint64_t failures = exact_counters().filter_failures;
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(centroid[axis], (expected.first[axis] / expected.volume).nearest_double());
  return failures;
}

TEST(Volume, nearest_double_is_that_of_the_rational) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(expect_nearest_as_by_rationals(with_fractions(random_triangles(0, 5, true, seed), seed)), 0U);
    EXPECT_EQ(expect_nearest_as_by_rationals(with_fractions(random_triangles(-20, 20, false, seed), seed)), 0U);
    expect_nearest_as_by_rationals(with_fractions(random_triangles(-300, 300, false, seed), seed));
    expect_nearest_as_by_rationals(random_triangles(-300, 300, false, seed));
  }
  using samples::MeshMaker;
  const Rational third(1, 3);
  EXPECT_EQ(expect_nearest_as_by_rationals(MeshMaker(third).box({1e-9, 1, -1e200}, {3e-9, 1e30, 1e190}).mesh()), 0U);
  // Far from the origin: the volume is the 10^-60th part of the box around both.
  EXPECT_EQ(expect_nearest_as_by_rationals(MeshMaker(third).box({1e20, 1e20, 1e20}, {1e20 + 32768, 2e20, 2e20}).mesh()),
            0U);
  EXPECT_EQ(expect_nearest_as_by_rationals(MeshMaker(third).box({1, 1, 1e300}, {2, 2, 2e300}).mesh()), 0U);
}

TEST(Volume, needs_the_rationals_to_round_what_lies_between_two_doubles) {
  // 1/3 of a box of 3 (2^53 + 1) is the middle of two doubles; a centroid of exactly 0 has no digits to round.
  const TriangleMesh middle = samples::MeshMaker(Rational(1, 3)).box({0, 0, 0}, {3, 3, 0x1p53 * 3 + 4}).mesh();
  EXPECT_EQ(expect_nearest_as_by_rationals(middle), 0U);
  const TriangleMesh centred = samples::MeshMaker(Rational(1, 3)).box({-1, -1, -1}, {1, 1, 1}).mesh();
  EXPECT_GT(expect_nearest_as_by_rationals(centred), 0U);
}

TEST(Volume, integers_at_the_limit_of_the_fast_sum_do_not_overflow) {
  const double big = 0x1p60 - 256;  // below 2^60, with the lowest bit 2^8
  const TriangleMesh mesh = samples::MeshMaker().box({-big, -big, -big}, {big, big, big}).mesh();
  expect_moments_as_by_rationals(mesh);
  const TriangleMesh mixed = samples::MeshMaker().box({-big, 1, -big}, {1, big, 3}).mesh();
  expect_moments_as_by_rationals(mixed);
  // 124 bits from the lowest to the highest.
  const double tiny = 0x1p-64;
  expect_moments_as_by_rationals(samples::MeshMaker().box({-big, tiny, -big}, {tiny, big, big}).mesh());
  expect_moments_as_by_rationals(samples::MeshMaker().box({-big, tiny / 2, -big}, {tiny / 2, big, big}).mesh());
}

TEST(Volume, box_has_the_product_of_its_sides_to_the_last_bit) {
  EXPECT_EQ(call("volume", cube(point(0.1, 0.2, 0.3), point(1.1, 2.2, 3.3))).get<double>(),
            ((Rational(1.1) - Rational(0.1)) * (Rational(2.2) - Rational(0.2)) * (Rational(3.3) - Rational(0.3)))
                .nearest_double());
  EXPECT_EQ(call("volume", cube(point(1e9, 1e9, 1e9), point(1e9 + 1, 1e9 + 1, 1e9 + 1))).get<double>(), 1.0);
}

TEST(Volume, a_number_beyond_the_doubles_is_undefined) {
  const auto answer = call("volume", cube(point(0, 0, 0), point(1e200, 1e200, 1)));
  EXPECT_FALSE(answer.is_defined());
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("finite"), std::string::npos);
}

TEST(Volume, cavity_is_taken_off) {
  const auto mesh = samples::MeshMaker().box({0, 0, 0}, {4, 4, 4}).box({1, 1, 1}, {2, 2, 2}, true).mesh();
  const auto solid = Volume3d::prove(mesh);
  ASSERT_TRUE(solid->is_defined());
  EXPECT_EQ(call("volume", **solid).get<double>(), 63.0);
  EXPECT_EQ(call("area", **solid).get<double>(), 102.0);
  // (64 * 2 - 1 * 1.5) / 63
  EXPECT_EQ(call("centroid", **solid).get<Point3d>().position.approx().x, Rational(253, 126).nearest_double());
}

TEST(Volume, torus_approaches_the_formula) {
  const auto solid = Volume3d::prove(samples::torus(400, 200));
  ASSERT_TRUE(solid->is_defined());
  const double pi = std::numbers::pi;
  EXPECT_NEAR(call("volume", **solid).get<double>(), 2 * pi * pi * 3, 0.02);
  EXPECT_NEAR(call("area", **solid).get<double>(), 4 * pi * pi * 3, 0.03);
  EXPECT_NEAR(call("centroid", **solid).get<Point3d>().position.approx().z, 0, 1e-12);
}

TEST(Area, slanted_triangles_with_whole_areas_are_exact) {
  // Sides 3-4-5 in a plane that is parallel to no axis: u = (1 2 2), v = (2 1 -2), both of length 3, at a right angle.
  const auto surface = calls::literal<Surface3d>("(((0 0 0) (1 2 2) (2 1 -2)) ((10 0 0) (11 2 2) (12 1 -2)))");
  EXPECT_EQ(call("area", surface).get<double>(), 9.0);
}

TEST(Area, large_and_small_triangle_are_summed_before_they_are_rounded) {
  // 2^53 + 1 lies between two doubles; with 1.5 more it does not.
  const auto surface = calls::literal<Surface3d>(
      "(((0 0 0) (134217728 0 0) (0 134217728 0)) ((-5 0 0) (-4 0 0) (-5 2 0)) ((-9 0 0) (-8 0 0) (-9 2 0)))");
  EXPECT_EQ(call("area", surface).get<double>(), 0x1p53 + 2);
}

TEST(Area, thirds_and_doubles_are_summed_together) {
  const auto surface = calls::literal<Surface3d>("(((0 0 0) (1/3 0 0) (0 6 0)) ((2 0 0) (3 0 0) (2 1 0)))");
  EXPECT_EQ(call("area", surface).get<double>(), 1.5);
}

TEST(Area, agrees_with_long_double_heron_on_needles) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a{unit(random), unit(random), unit(random)}, b{unit(random), unit(random), unit(random)};
    const Vec3 c = 0.5 * (a + b) + 1e-9 * Vec3{unit(random), unit(random), unit(random)};
    const TriangleMesh mesh(PointArray({a, b, c}), std::vector<TriangleMesh::Triangle>{{0, 1, 2}});
    const RationalVec3 normal = cross(RationalVec3(b) - RationalVec3(a), RationalVec3(c) - RationalVec3(a));
    const double expected = (dot(normal, normal) / Rational(4)).nearest_root();
    EXPECT_EQ(*nearest_area(mesh.points(), triangles_of(mesh)), expected);
  }
}

TEST(Area, of_many_triangles_is_the_exact_sum_rounded_once) {
  // Half the lengths of two legs at a right angle, in planes parallel to an axis: the areas are known exactly.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const int bits : {24, 50, 53}) {
    const auto any = [&] { return std::ldexp(std::round(std::ldexp(number(random), bits)), -bits); };
    for (int round = 0; round < 50; ++round) {
      std::vector<Vec3> points;
      std::vector<TriangleMesh::Triangle> triangles;
      Rational expected;
      for (std::uint32_t i = 0; i < 40; ++i) {
        const Vec3 a{any(), any(), any()};
        points.insert(points.end(), {a, {any(), a.y, a.z}, {a.x, any(), a.z}});
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        const Rational width = Rational(points[3 * i + 1].x) - Rational(a.x);
        const Rational height = Rational(points[3 * i + 2].y) - Rational(a.y);
        expected += (width * height).abs() / Rational(2);
      }
      EXPECT_EQ(*nearest_area(PointArray(points), triangles), expected.nearest_double());
    }
  }
}

TEST(Area, of_triangles_with_fractions_is_rounded_once) {
  // As above, all coordinates divided by an odd number; some legs are far shorter than doubles tell.
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const std::int64_t divisor : {3, 7, 1000000007}) {
    const auto any = [&] { return Rational(number(random)) / Rational(divisor); };
    for (int round = 0; round < 30; ++round) {
      PointArray points;
      std::vector<TriangleMesh::Triangle> triangles;
      Rational expected;
      for (std::uint32_t i = 0; i < 40; ++i) {
        const Rational x = any(), y = any(), z = any();
        const Rational width = i % 4 == 0 ? any() * Rational(0x1p-60) : any(), height = any();
        points.push_back(ExactPoint(RationalVec3(x, y, z)));
        points.push_back(ExactPoint(RationalVec3(x + width, y, z)));
        points.push_back(ExactPoint(RationalVec3(x, y + height, z)));
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        expected += (width * height).abs() / Rational(2);
      }
      reset_exact_counters();
      EXPECT_EQ(*nearest_area(points, triangles), expected.nearest_double());
      EXPECT_EQ(exact_counters().filter_failures, 0U);
    }
  }
}

TEST(Area, halfway_between_two_doubles_is_rounded_to_even) {
  for (const double odd : {0x1p53 + 2, 0x1p53 + 4}) {
    // Triangles of the areas odd and 1.
    const PointArray points({{0, 0, 0}, {odd, 0, 0}, {0, 2, 0}, {5, 5, 1}, {6, 5, 1}, {5, 7, 1}});
    const std::vector<TriangleMesh::Triangle> triangles{{0, 1, 2}, {3, 4, 5}};
    EXPECT_EQ(*nearest_area(points, triangles), (Rational(odd) + 1).nearest_double());
  }
}

TEST(Area, of_a_smooth_solid_takes_no_long_roots) {
  const TriangleMesh mesh = samples::torus(100, 60, {0.1, 20.3, -7.7});
  reset_exact_counters();
  EXPECT_GT(*nearest_area(mesh.points(), triangles_of(mesh)), 0);
  EXPECT_EQ(exact_counters().big_fallbacks, 0U);
}

TEST(Area, at_the_ends_of_the_range_is_that_of_the_scaled_solid) {
  const TriangleMesh mesh = samples::torus(20, 12);
  const double area = *nearest_area(mesh.points(), triangles_of(mesh));
  for (const int exponent : {-500, -300, -120, 100, 199, 400, 500}) {
    std::vector<Vec3> points;
    for (const Vec3& p : mesh.points().approx()) points.push_back(std::ldexp(1.0, exponent) * p);
    EXPECT_EQ(*nearest_area(PointArray(points), triangles_of(mesh)), std::ldexp(area, 2 * exponent)) << exponent;
  }
}

TEST(Centroid, of_a_moved_cube_is_its_middle) {
  const auto centre = call("centroid", cube(point(1, 2, 3), point(2, 4, 6)));
  EXPECT_EQ(centre.text(), "(1.5 3.0 4.5)");
}

TEST(Centroid, of_the_empty_solid_is_undefined_with_a_reason) {
  const auto answer = call("centroid", Volume3d());
  EXPECT_FALSE(answer.is_defined());
  EXPECT_EQ(answer.diagnostics, std::vector<std::string>{"centroid: an empty solid has no centroid"});
  EXPECT_EQ(call("volume", Volume3d()).get<double>(), 0.0);
}

}  // namespace
}  // namespace algebra3d
