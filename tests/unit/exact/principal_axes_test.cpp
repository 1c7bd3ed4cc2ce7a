// Matrices whose eigenvalues and eigenvectors are known: an exact rotation of a diagonal matrix.
#include "algebra3d/kernel/exact/principal_axes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "algebra3d/kernel/exact/mass_properties.h"
#include "algebra3d/kernel/exact/plane.h"
#include "base/box_corners.h"

namespace algebra3d {
namespace {

/// Three orthogonal vectors of equal length, from a quaternion of integers.
std::array<RationalVec3, 3> orthogonal(const std::array<int, 4>& q) {
  const auto [a, b, c, d] = q;
  return {RationalVec3(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)),
          RationalVec3(2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b)),
          RationalVec3(2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d)};
}

SymmetricMatrix matrix_of(const std::array<RationalVec3, 3>& axes, const std::array<Rational, 3>& values) {
  SymmetricMatrix m;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational factor = values[i] / dot(axes[i], axes[i]);
    const RationalVec3& u = axes[i];
    m.xx += factor * u.x * u.x, m.yy += factor * u.y * u.y, m.zz += factor * u.z * u.z;
    m.yz += factor * u.y * u.z, m.zx += factor * u.z * u.x, m.xy += factor * u.x * u.y;
  }
  return m;
}

Vec3 rounded(const RationalVec3& v) {
  return {v.x.nearest_double(), v.y.nearest_double(), v.z.nearest_double()};
}

void expect_parallel(const Vec3& axis, const RationalVec3& direction) {
  const Vec3 expected = 1 / dot(direction, direction).nearest_root() * rounded(direction);
  const double sign = dot(axis, expected) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(axis[i], sign * expected[i], 0x1p-50);
}

std::array<Rational, 3> spectrum(std::mt19937& random) {
  const auto number = [&] { return Rational(static_cast<std::int64_t>(1 + random() % 1000), 7); };
  const Rational tiny = *Rational::parse("1e-25");
  const Rational first = number();
  switch (random() % 5) {
    case 0:
      return {first, first, first + number()};
    case 1:
      return {first, first + number(), first + number() + Rational(1000)};
    case 2:
      return {first, first + tiny, first + number()};  // nearly equal
    case 3:
      return {tiny * first, first, first + tiny};  // a rod
    default:
      return {first, first + number() + Rational(1), first + Rational(2000)};
  }
}

TEST(principal_axes, of_rotated_diagonal_matrices) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    std::array<int, 4> quaternion{};
    for (int& part : quaternion) part = static_cast<int>(random() % 21) - 10;
    if (quaternion == std::array<int, 4>{}) continue;
    const auto axes = orthogonal(quaternion);
    std::array<Rational, 3> values = spectrum(random);
    std::ranges::sort(values);
    const PrincipalAxes found = principal_axes(matrix_of(axes, values));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(found.values[i], values[i].nearest_double());
      const bool is_alone = (i == 0 || values[i - 1] != values[i]) && (i == 2 || values[i] != values[i + 1]);
      if (is_alone) expect_parallel(found.axes[i], axes[i]);
    }
    EXPECT_EQ(found.are_equal[0], values[0] == values[1]);
    EXPECT_EQ(found.are_equal[1], values[1] == values[2]);
    EXPECT_NEAR(dot(cross(found.axes[0], found.axes[1]), found.axes[2]), 1, 0x1p-49);
    if (testing::Test::HasFailure()) return;
  }
}

// The estimates know nothing of values that are far below the trace.
TEST(principal_axes, of_values_of_all_sizes) {
  const auto power = [](int exponent) { return Rational(std::ldexp(1.0, exponent)); };
  const auto axes = orthogonal({3, -1, 4, 1});
  for (const std::array<int, 3> exponents : {std::array{400, 410, 1000}, std::array{-1000, 390, 1000},
                                             std::array{-1000, -999, 1000}, std::array{-900, 900, 901}}) {
    const auto [a, b, c] = exponents;
    const PrincipalAxes found = principal_axes(matrix_of(axes, {power(a), power(b), power(c)}));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(found.values[i], std::ldexp(1.0, exponents[i]));
      expect_parallel(found.axes[i], axes[i]);
    }
  }
}

TEST(principal_axes, are_those_of_the_coordinates_if_all_values_are_equal) {
  const PrincipalAxes found = principal_axes({Rational(3), Rational(3), Rational(3), 0, 0, 0});
  EXPECT_EQ(found.values, (std::array<double, 3>{3, 3, 3}));
  EXPECT_EQ(found.axes[0], (Vec3{1, 0, 0}));
  EXPECT_EQ(found.axes[1], (Vec3{0, 1, 0}));
  EXPECT_EQ(found.axes[2], (Vec3{0, 0, 1}));
}

TEST(principal_axes, of_a_double_value_follow_the_coordinates) {
  // Around x: y is the first coordinate axis at a right angle.
  const PrincipalAxes found = principal_axes({Rational(9), Rational(2), Rational(2), 0, 0, 0});
  EXPECT_EQ(found.axes[0], (Vec3{0, 1, 0}));
  EXPECT_EQ(found.axes[1], (Vec3{0, 0, 1}));
  EXPECT_EQ(found.axes[2], (Vec3{1, 0, 0}));
}

// A box of 2 x 4 x 6, and the corner of it with legs of this length, at places that need integers of all widths.
class mass_properties_at : public testing::TestWithParam<const char*> {};

MassProperties properties_of(const std::vector<std::array<int, 3>>& corners,
                             const std::vector<std::array<std::uint32_t, 3>>& triangles, const Rational& shift) {
  PointArray points;
  for (const auto& [x, y, z] : corners)
    points.push_back(ExactPoint(RationalVec3(Rational(x) + shift, Rational(y) + shift, Rational(z) + shift)));
  return *mass_properties(points, triangles);
}

TEST_P(mass_properties_at, of_solids_by_hand) {
  const Rational shift = *Rational::parse(GetParam());
  const MassProperties box =
      properties_of({{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {2, 4, 0}, {0, 0, 6}, {2, 0, 6}, {0, 4, 6}, {2, 4, 6}},
                    {kBoxTriangles.begin(), kBoxTriangles.end()}, shift);
  EXPECT_EQ(box.volume, Rational(48));
  EXPECT_EQ(box.centre, RationalVec3(Rational(1) + shift, Rational(2) + shift, Rational(3) + shift));
  // V/12 (b^2 + c^2).
  EXPECT_EQ(box.inertia.xx, Rational(4 * (16 + 36)));
  EXPECT_EQ(box.inertia.yy, Rational(4 * (36 + 4)));
  EXPECT_EQ(box.inertia.zz, Rational(4 * (4 + 16)));
  EXPECT_EQ(box.inertia.yz, Rational(0));
  EXPECT_EQ(box.inertia.zx, Rational(0));
  EXPECT_EQ(box.inertia.xy, Rational(0));
  // About its centre: integrals of xx V a^2/10 - V a^2/16, of xy V ab/20 - V ab/16.
  const MassProperties corner =
      properties_of({{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 6}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, shift);
  EXPECT_EQ(corner.volume, Rational(8));
  EXPECT_EQ(corner.inertia.xx, Rational(8 * 3 * (16 + 36), 80));
  EXPECT_EQ(corner.inertia.zz, Rational(8 * 3 * (4 + 16), 80));
  EXPECT_EQ(corner.inertia.xy, Rational(8 * 8, 80));
  EXPECT_EQ(corner.inertia.yz, Rational(8 * 24, 80));
  EXPECT_EQ(corner.inertia.zx, Rational(8 * 12, 80));
}
INSTANTIATE_TEST_SUITE_P(places, mass_properties_at,
                         testing::Values("0", "1e9", "1/1152921504606846976", "1/1329227995784915872903807060280344576",
                                         "1/3"));

}  // namespace
}  // namespace algebra3d
