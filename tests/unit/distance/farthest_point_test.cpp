// The largest distance of one set from another: cases by hand, and random sets against samples.
#include "algebra3d/kernel/distance/farthest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "unit/distance/farthest.h"

namespace algebra3d {
namespace {

using Set = TriangleSet;

void expect_bound(const FarthestPoint& farthest) {
  EXPECT_GE(farthest.upper_bound, distance_of(farthest));
  EXPECT_LE(farthest.upper_bound, distance_of(farthest) * (1 + 0x1p-29) + 1e-10);
}

/// A rectangle at a height, of several squares, each divided along one of its diagonals.
Set plate(double x, double y, double width, double z, int count, bool is_turned) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto side = static_cast<std::uint32_t>(count + 1);
  for (int i = 0; i <= count; ++i)
    for (int j = 0; j <= count; ++j) points.push_back({x + i * width / count, y + j * width / count, z});
  for (std::uint32_t i = 0; i + 1 < side; ++i)
    for (std::uint32_t j = 0; j + 1 < side; ++j) {
      const std::uint32_t a = i * side + j, b = a + side, c = b + 1, d = a + 1;
      if (is_turned) {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      } else {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      }
    }
  return {std::move(points), std::move(triangles)};
}

TEST(FarthestPoint, AVertexIsFarthest) {
  const Set from({{0, 0, 1}, {1, 0, 1}, {0, 0, 7}}, {{0, 1, 2}}), to = plate(-4, -4, 8, 0, 1, false);
  const FarthestPoint point = farthest(from, to);
  EXPECT_EQ(point.squared_distance, 49);
  EXPECT_EQ(point.point, ExactPoint(Vec3{0, 0, 7}));
  expect_bound(point);
}

// The cubes have the sides u and 4 u; the corner (4 u, 4 u, 4 u) is 3 u from the other cube along each axis.
TEST(FarthestPoint, CubesOfTheSizeOfTheLeastDoubles) {
  for (const int exponent : {-1074, -1073, -1070, -1060, -1022, -901, -899, -500}) {
    const double u = std::ldexp(1.0, exponent);
    const auto cube = [](double side) {
      std::vector<Vec3> points;
      for (int i = 0; i < 8; ++i) points.push_back({side * (i & 1), side * (i >> 1 & 1), side * (i >> 2 & 1)});
      return Set(std::move(points), {{0, 2, 1},
                                     {1, 2, 3},
                                     {4, 5, 6},
                                     {5, 7, 6},
                                     {0, 1, 4},
                                     {1, 5, 4},
                                     {2, 6, 3},
                                     {3, 6, 7},
                                     {0, 4, 2},
                                     {2, 4, 6},
                                     {1, 3, 5},
                                     {3, 7, 5}});
    };
    const Rational unit(u);
    EXPECT_EQ(farthest(cube(4 * u), cube(u)).squared_distance, 27 * unit * unit) << exponent;
    EXPECT_EQ(farthest(cube(4 * u), cube(u)).point, ExactPoint(Vec3{4 * u, 4 * u, 4 * u})) << exponent;
  }
}

TEST(FarthestPoint, ParallelPlatesOfDifferentTriangles) {
  const Set from = plate(0, 0, 5, 0.375, 7, false), to = plate(-1, -1, 7, 0, 5, true);
  const FarthestPoint point = farthest(from, to);
  EXPECT_EQ(point.squared_distance, Rational(9, 64));
  expect_bound(point);
}

TEST(FarthestPoint, TheSamePlateOfDifferentTriangles) {
  const Set from = plate(0, 0, 5, 1, 7, false), to = plate(0, 0, 5, 1, 5, true);
  const FarthestPoint point = farthest(from, to);
  EXPECT_LE(distance_of(point), 1e-11);
  expect_bound(point);
}

/// A point of a ring in the plane z = slope * (x + 2 y), whose coordinates are integers.
Vec3 on_ring(double radius, int i, int count, double slope) {
  const double angle = 2 * std::numbers::pi * i / count, x = std::round(radius * std::cos(angle)),
               y = std::round(radius * std::sin(angle));
  return {x, y, slope * (x + 2 * y)};
}

/// A disc of needles with a common tip, or with a hole around the middle.
Set disc(double radius, double hole, int count, double slope) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (int i = 0; i < count; ++i) points.push_back(on_ring(radius, i, count, slope));
  const auto n = static_cast<std::uint32_t>(count);
  for (int i = 0; i < count && hole > 0; ++i) points.push_back(on_ring(hole, i, count, slope));
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    if (hole > 0) {
      triangles.push_back({i, next, n + i});
      triangles.push_back({next, n + next, n + i});
    } else if (i > 0 && next > 0) {
      triangles.push_back({0, i, next});
    }
  }
  return {std::move(points), std::move(triangles)};
}

TEST(FarthestPoint, OverASlantedFacetOfManyTriangles) {
  // The planes are 6 / sqrt(6) apart.
  const auto above = [](double x, double y) { return Vec3{x, y, x + 2 * y + 6}; };
  const Set from({above(-300, -300), above(600, -200), above(-100, 500), above(400, 400)}, {{0, 1, 2}, {1, 3, 2}});
  const FarthestPoint point = farthest(from, disc(1000, 0, 500, 1));
  EXPECT_NEAR(distance_of(point), std::sqrt(6.0), 1e-9);
  expect_bound(point);
}

TEST(FarthestPoint, OverTheHoleOfAFacet) {
  const FarthestPoint point = farthest(plate(-400, -400, 800, 300, 1, true), disc(1000, 100, 200, 0));
  EXPECT_NEAR(distance_of(point), std::hypot(300, 100), 0.1);
  EXPECT_GT(distance_of(point), 316);  // beside the hole it is 300
  expect_bound(point);
}

TEST(FarthestPoint, BeyondTheOutlineOfAFacet) {
  const Set from({{0, 0, 5}, {2000, 0, 5}, {0, 300, 5}}, {{0, 1, 2}});
  const FarthestPoint point = farthest(from, disc(1000, 0, 400, 0));
  EXPECT_EQ(point.squared_distance, 1000 * 1000 + 25);
  expect_bound(point);
}

TEST(FarthestPoint, ARidgeBetweenTwoRails) {
  // Rails along x at y = -3 and y = 7 and the height 12 below: all points of the plate with y = 2 are at 13.
  const Set from = plate(0, 0, 4, 0, 3, false);
  const Set to({{-9, -3, -12}, {9, -3, -12}, {-9, 7, -12}, {9, 7, -12}}, {{0, 1, 1}, {2, 3, 3}});
  const FarthestPoint point = farthest(from, to);
  EXPECT_NEAR(distance_of(point), 13, 13e-9);
  EXPECT_GE(point.upper_bound, 13);
  expect_bound(point);
}

TEST(FarthestPoint, EquallyFarFromThreePoints) {
  // The circumcircle of the points has its centre at (0, 0) and the radius 5; 12 above it.
  const Set from = plate(-2, -3, 6, 12, 1, true);
  const Set to({{5, 0, 0}, {-3, 4, 0}, {-4, -3, 0}}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  const FarthestPoint point = farthest(from, to);
  EXPECT_GE(distance_of(point), 13 - 13e-9);
  expect_bound(point);
}

TEST(FarthestPoint, TheFarthestOfSeveralSearches) {
  const Set low = plate(0, 0, 1, 1, 1, false), high = plate(0, 0, 1, 5, 1, false),
            ground = plate(-1, -1, 3, 0, 2, true);
  const std::array<FarthestSearch, 2> searches{{{low.operand(), ground.operand()}, {high.operand(), ground.operand()}}};
  const auto point = farthest_point(searches).value();
  EXPECT_EQ(point->squared_distance, 25);
  EXPECT_EQ(point->search, 1U);
  EXPECT_FALSE(farthest_point({}).value());
}

// A distance that one search finds saves work of the others, so they take their steps by turns.
TEST(FarthestPoint, TheOrderOfSearchesDoesNotMatter) {
  const Set low = plate(0, 0, 1, 1, 3, false), high = plate(0.3, 0.2, 1, 1.25, 4, true),
            ridge({{-1, 0, 2}, {2, 0, 2}, {-1, -3, 0}, {2, 4, 0.5}}, {{0, 1, 2}, {0, 1, 3}});
  std::vector<FarthestSearch> searches;
  for (const Set* from : {&low, &high, &ridge})
    for (const Set* to : {&low, &high, &ridge})
      if (from != to) searches.push_back({from->operand(), to->operand()});
  const auto forwards = farthest_point(searches).value();
  std::ranges::reverse(searches);
  const auto backwards = farthest_point(searches).value();
  EXPECT_EQ(forwards->squared_distance, backwards->squared_distance);
  EXPECT_EQ(forwards->upper_bound, backwards->upper_bound);
  EXPECT_EQ(forwards->search, searches.size() - 1 - backwards->search);
}

TEST(FarthestPoint, AnEdgeBesideARidge) {
  // The plate begins at y = 0; the points that are equally far from both rails are at y = 5e-8.
  const Set to({{-9, -5, 0}, {9, -5, 0}, {-9, 5 + 1e-7, 0}, {9, 5 + 1e-7, 0}}, {{0, 1, 1}, {2, 3, 3}});
  const FarthestPoint point = farthest(plate(-4, 0, 8, 12, 5, false), to);
  expect_bound(point);
  EXPECT_GE(point.upper_bound, std::hypot(12, 5 + 5e-8) * (1 - 0x1p-50));
  EXPECT_LE(distance_of(point), std::hypot(12, 5 + 5e-8) * (1 + 0x1p-50));
}

TEST(FarthestPoint, RandomSetsAgainstSamples) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(0, 1);
  for (int round = 0; round < 40; ++round) {
    const auto draw = [&](int count) {
      std::vector<Vec3> points;
      std::vector<TriangleMesh::Triangle> triangles;
      for (int i = 0; i < 3 * count; ++i)
        points.push_back({coordinate(random), coordinate(random), coordinate(random)});
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i)
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      return Set(std::move(points), std::move(triangles));
    };
    const Set a = draw(3), b = draw(5);
    const FarthestPoint point = farthest(a, b);
    expect_bound(point);
    constexpr int kSteps = 12;
    double sampled = 0;
    for (std::size_t f = 0; f < a.mesh.face_count(); ++f)
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) {
          const TriangleRef t = a.mesh.corners(FaceId(f));
          const double u = double(i) / kSteps, v = double(j) / kSteps;
          const Set sample({t[0].approx + u * (t[1].approx - t[0].approx) + v * (t[2].approx - t[0].approx)},
                           {{0, 0, 0}});
          const double distance = (*closest_points(sample.operand(), b.operand()))->squared_distance.nearest_root();
          sampled = std::max(sampled, distance);
        }
    EXPECT_LE(sampled, point.upper_bound + 1e-12);
    EXPECT_GE(sampled, distance_of(point) - 1.8 / kSteps);
    const Set found({point.point.approx()}, {{0, 0, 0}});
    EXPECT_EQ((*closest_points(found.operand(), b.operand()))->squared_distance, point.squared_distance);
    EXPECT_LE((*closest_points(found.operand(), a.operand()))->squared_distance.nearest_root(), 1e-14);
  }
}

TEST(FarthestPoint, CanBeCancelled) {
  const std::atomic<bool> cancel = true;
  const Set set = plate(0, 0, 1, 0, 1, false);
  const FarthestSearch search{set.operand(), set.operand()};
  EXPECT_EQ(farthest_point({&search, 1}, &cancel).error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
