// The nearest points of wavy sheets of many faces, which lie aslant and hang over each other, beside all pairs of
// faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "algebra3d/kernel/distance/detail/rounded_closest.h"
#include "algebra3d/kernel/distance/distance.h"
#include "support/rounds.h"
#include "unit/distance/triangle_set.h"

namespace algebra3d {
namespace {

using distances::DistanceBounds;

/// A sheet of 2 n^2 faces over a square of side 2, with waves, turned around an axis by an angle, then moved.
TriangleSet sheet(std::uint32_t n, std::mt19937& random, const Vec3& shift, double scale) {
  std::uniform_real_distribution<double> share(0, 1);
  const double height = 0.3 * share(random), waves = 1 + 6 * share(random), angle = 3 * share(random);
  const Vec3 axis{1 / std::sqrt(3.0), 1 / std::sqrt(3.0), 1 / std::sqrt(3.0)};
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
      const Vec3 p{x, y, height * std::sin(waves * x) * std::cos(waves * y + angle)};
      const Vec3 turned =
          std::cos(angle) * p + std::sin(angle) * cross(axis, p) + ((1 - std::cos(angle)) * dot(axis, p)) * axis;
      points.push_back(scale * (turned + shift));
    }
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      triangles.push_back({a, b, b + 1});
      triangles.push_back({a, b + 1, a + 1});
    }
  return {std::move(points), std::move(triangles)};
}

/// The least bounds of all pairs of faces.
DistanceBounds bounds_of_all_pairs(const DistanceOperand& a, const DistanceOperand& b) {
  const distances::RoundedDistances rounded(unite(a.hierarchy->bounds(), b.hierarchy->bounds()));
  DistanceBounds least;
  least.lower = least.upper = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < a.mesh->face_count(); ++f)
    for (std::size_t g = 0; g < b.mesh->face_count(); ++g) {
      const DistanceBounds bounds = rounded.bounds(distances::Simplex::of_face(*a.mesh, FaceId(f)),
                                                   distances::Simplex::of_face(*b.mesh, FaceId(g)));
      least.lower = std::min(least.lower, bounds.lower);
      least.upper = std::min(least.upper, bounds.upper);
    }
  return least;
}

TEST(NearPairs, of_wavy_sheets_are_the_nearest_of_all) {
  std::mt19937 random(3);  // NOLINT(cert-msc51-cpp): the same sheets each time
  std::uniform_real_distribution<double> coordinate(-2.5, 2.5);
  for (int round = 0; round < rounds(7); ++round) {
    SCOPED_TRACE(round);
    const double scale = std::ldexp(1.0, (round % 5 - 2) * 200);
    // Some have too few faces for the first pair to be looked for.
    const std::uint32_t n = round % 3 == 0 ? 7 : 14;
    const TriangleSet first = sheet(n, random, {0, 0, 0}, scale);
    const TriangleSet second =
        sheet(n + 3, random, {coordinate(random), coordinate(random), coordinate(random)}, scale);
    const DistanceBounds expected = bounds_of_all_pairs(first.operand(), second.operand());
    const auto found = closest_points(first.operand(), second.operand()).value();
    ASSERT_TRUE(found.has_value());
    const double distance = found->squared_distance.nearest_root();
    EXPECT_GE(distance, expected.lower);
    EXPECT_LE(distance, expected.upper);
    if (expected.lower == 0) continue;
    EXPECT_FALSE(*are_within(first.operand(), second.operand(), Rational(expected.lower * (1 - 0x1p-40))));
    EXPECT_TRUE(*are_within(first.operand(), second.operand(), Rational(expected.upper)));
  }
}

}  // namespace
}  // namespace algebra3d
