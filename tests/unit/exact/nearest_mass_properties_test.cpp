// Rounded mass properties against the exact ones, rounded: of solids whose corners are not doubles.
#include "algebra3d/kernel/exact/nearest_mass_properties.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "algebra3d/kernel/exact/counters.h"
#include "base/box_corners.h"

namespace algebra3d {
namespace {

struct Solid {
  PointArray points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A tetrahedron with the outside in front of its triangles.
void add_tetrahedron(Solid& solid, std::array<RationalVec3, 4> corners) {
  const RationalVec3 &a = corners[0], u = corners[1] - a, v = corners[2] - a, w = corners[3] - a;
  if (dot(cross(u, v), w).sign() < 0) std::swap(corners[1], corners[2]);
  const auto first = static_cast<std::uint32_t>(solid.points.size());
  for (const RationalVec3& corner : corners) solid.points.push_back(ExactPoint(corner));
  for (const auto& [i, j, k] : {std::array{0U, 2U, 1U}, {0U, 1U, 3U}, {0U, 3U, 2U}, {1U, 2U, 3U}})
    solid.triangles.push_back({first + i, first + j, first + k});
}

Solid random_solid(std::mt19937& random, const Rational& shift) {
  Solid solid;
  const auto number = [&] {
    return Rational(static_cast<std::int64_t>(random() % 20001) - 10000, static_cast<std::int64_t>(1 + random() % 997));
  };
  for (int i = 0; i < 5; ++i) {
    std::array<RationalVec3, 4> corners;
    for (RationalVec3& corner : corners) corner = RationalVec3(number() + shift, number(), number() - shift);
    add_tetrahedron(solid, corners);
  }
  return solid;
}

void expect_rounded(const Solid& solid) {
  const MassProperties exact = *mass_properties(solid.points, solid.triangles);
  const NearestMassProperties found = *nearest_mass_properties(solid.points, solid.triangles);
  EXPECT_EQ(found.volume, exact.volume.nearest_double());
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(found.centre[axis], exact.centre[axis].nearest_double());
  const auto& [xx, yy, zz, yz, zx, xy] = exact.inertia;
  const std::array<const Rational*, 6> entries{&xx, &yy, &zz, &yz, &zx, &xy};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(found.inertia[i], entries[i]->nearest_double());
  const PrincipalAxes axes = principal_axes(exact.inertia);
  EXPECT_EQ(found.principal.values, axes.values);
  EXPECT_EQ(found.principal.are_equal, axes.are_equal);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(found.principal.axes[i][axis], axes.axes[i][axis], 0x1p-49);
}

TEST(NearestMassProperties, AreTheExactOnesRounded) {
  std::mt19937 random(5);
  for (const char* shift : {"0", "1/3", "1000000/7", "100000000000000000000/3"})
    for (int round = 0; round < 20; ++round) {
      SCOPED_TRACE(std::string(shift) + ", round " + std::to_string(round));
      expect_rounded(random_solid(random, *Rational::parse(shift)));
    }
}

TEST(NearestMassProperties, NeedNoExactSums) {
  std::mt19937 random(6);
  const Solid solid = random_solid(random, Rational(1, 3));
  const std::uint64_t before = exact_counters().filter_failures;
  ASSERT_TRUE(nearest_mass_properties(solid.points, solid.triangles).ok());
  ASSERT_TRUE(approximate_mass_properties(solid.points, solid.triangles).ok());
  EXPECT_EQ(exact_counters().filter_failures, before);
}

TEST(NearestMassProperties, OfSymmetricSolidsHaveExactZerosAndEqualMoments) {
  for (const std::array<int, 3>& size : {std::array{2, 4, 6}, {2, 2, 6}, {3, 3, 3}}) {
    Solid solid;
    for (unsigned i = 0; i < 8; ++i) {
      const auto coordinate = [&](unsigned axis) {
        return Rational(static_cast<int>(i >> axis & 1U) * size[axis]) + Rational(1, 3);
      };
      solid.points.push_back(ExactPoint(RationalVec3(coordinate(0), coordinate(1), coordinate(2))));
    }
    solid.triangles.assign(kBoxTriangles.begin(), kBoxTriangles.end());
    expect_rounded(solid);
    const NearestMassProperties found = *nearest_mass_properties(solid.points, solid.triangles);
    EXPECT_EQ(found.inertia[3], 0);
    EXPECT_EQ(found.principal.are_equal[0] || found.principal.are_equal[1], size[0] == size[1]);
  }
}

TEST(NearestMassProperties, ApproximateOnesAreWithinTheirBound) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    const Solid solid = random_solid(random, Rational(1'000'000, 7));
    const MassProperties exact = *mass_properties(solid.points, solid.triangles);
    const MassProperties found = *approximate_mass_properties(solid.points, solid.triangles);
    EXPECT_LT((found.volume - exact.volume).abs(), Rational(0x1p-79) * exact.volume);
    const Rational trace = exact.inertia.xx + exact.inertia.yy + exact.inertia.zz;
    EXPECT_LT((found.inertia.xy - exact.inertia.xy).abs(), Rational(0x1p-79) * trace);
    EXPECT_LT((found.inertia.zz - exact.inertia.zz).abs(), Rational(0x1p-79) * trace);
    const RationalVec3 off = found.centre - exact.centre;
    EXPECT_LT(dot(off, off) * exact.volume, Rational(0x1p-158) * trace);
  }
}

}  // namespace
}  // namespace algebra3d
