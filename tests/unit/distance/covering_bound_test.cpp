#include "algebra3d/kernel/distance/covering_bound.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "unit/distance/farthest.h"

namespace algebra3d {
namespace {

constexpr std::size_t kManyPieces = 1'000'000;

double bound(const TriangleSet& from, const TriangleSet& to, double enough) {
  const auto result = covering_bound(from.mesh, to.operand(), enough, kManyPieces);
  EXPECT_TRUE(result.ok() && result->has_value());
  return result.ok() ? result->value_or(-1) : -1;
}

/// A square of side 2 around the origin, of needles from the middle of one side to points of the others.
TriangleSet square_of_needles(std::uint32_t count, double height) {
  std::vector<Vec3> points{{0, -1, height}};
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i <= count; ++i) {
    const double way = 6.0 * i / count;  // along the sides
    points.push_back(way <= 2   ? Vec3{1, way - 1, height}
                     : way <= 4 ? Vec3{3 - way, 1, height}
                                : Vec3{-1, 5 - way, height});
    if (i > 0) triangles.push_back({0, i, i + 1});
  }
  return {points, triangles};
}

TEST(CoveringBound, of_a_triangle_above_needles_is_its_height) {
  for (const std::uint32_t count : {3U, 30U, 3000U})
    for (const double height : {1e-3, 1e-9, 1e-14}) {
      SCOPED_TRACE(height);
      const TriangleSet triangle({{-0.5, -0.5, 0}, {0.7, -0.3, 0}, {0.1, 0.6, 0}}, {{0, 1, 2}});
      const double found = bound(triangle, square_of_needles(count, height), height);
      EXPECT_GE(found, height);
      EXPECT_LE(found, 4.3 * height);
    }
}

TEST(CoveringBound, counts_what_reaches_beyond_the_other_set) {
  const TriangleSet triangle({{-0.5, -0.5, 0}, {3, -0.3, 0}, {0.1, 0.6, 0}}, {{0, 1, 2}});
  const double found = bound(triangle, square_of_needles(30, 0), 1e-3);
  EXPECT_GE(found, 2);
  EXPECT_LE(found, 8.6);
}

TEST(CoveringBound, of_triangles_without_area) {
  const TriangleSet point({{1, 0, 0}}, {{0, 0, 0}}), segment({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}, {{0, 1, 2}});
  EXPECT_LE(bound(point, segment, 1e-6), 2e-6);
  EXPECT_GE(bound(segment, point, 1e-6), 1);
  EXPECT_LE(bound(segment, point, 1e-6), 4.3);
  EXPECT_LE(bound(segment, segment, 1e-6), 2e-6);
}

TriangleSet random_triangles(std::mt19937_64& random, std::uint32_t count) {
  std::uniform_real_distribution<double> anywhere(-1, 1);
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 a{anywhere(random), anywhere(random), anywhere(random)};
    const Vec3 b{anywhere(random), anywhere(random), anywhere(random)};
    const double share = anywhere(random), offset = i % 2 == 0 ? 1e-9 : 1;  // every second one is a needle
    points.insert(points.end(), {a, b, a + share * (b - a) + offset * Vec3{anywhere(random), anywhere(random), 0}});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {points, triangles};
}

TEST(CoveringBound, is_near_the_exact_distance_of_random_triangles) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const TriangleSet from = random_triangles(random, 6), to = random_triangles(random, 12);
    const double exact = distance_of(farthest(from, to)), found = bound(from, to, 0.01);
    EXPECT_GE(found, exact);
    EXPECT_LE(found, 4.3 * exact);
  }
}

TEST(CoveringBound, is_nothing_without_another_set_or_with_too_much_work) {
  const TriangleSet empty({}, {}), square = square_of_needles(30, 0);
  EXPECT_EQ(bound(empty, square, 1), 0);
  EXPECT_FALSE(covering_bound(square.mesh, empty.operand(), 1, kManyPieces)->has_value());
  EXPECT_FALSE(covering_bound(square.mesh, square.operand(), 1e-9, 29)->has_value());
  EXPECT_TRUE(covering_bound(square.mesh, square.operand(), 1e-9, 10'000)->has_value());
}

TEST(CoveringBound, can_be_interrupted) {
  const TriangleSet square = square_of_needles(30, 0);
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(covering_bound(square.mesh, square.operand(), 1e-9, kManyPieces, &cancel).error().code,
            ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
