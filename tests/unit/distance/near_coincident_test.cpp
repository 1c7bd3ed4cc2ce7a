// The largest distance of sets that nearly coincide, where it is in the inside of faces: closed forms, and samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

#include "algebra3d/kernel/distance/detail/face_bounds.h"
#include "algebra3d/kernel/distance/distance_bound.h"
#include "base/scheduler.h"
#include "support/rounds.h"
#include "unit/distance/farthest.h"

namespace algebra3d {
namespace {

using Triangles = std::vector<TriangleMesh::Triangle>;

Vec3 turned(const Vec3& p, const Vec3& unit_axis, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return c * p + s * cross(unit_axis, p) + ((1 - c) * dot(unit_axis, p)) * unit_axis;
}

/// A square around the origin at z = 0, turned in its plane.
TriangleSet square(double side, int count, double radians) {
  std::vector<Vec3> points;
  Triangles triangles;
  const auto row = static_cast<std::uint32_t>(count + 1);
  for (int i = 0; i <= count; ++i)
    for (int j = 0; j <= count; ++j)
      points.push_back(turned({side * i / count - side / 2, side * j / count - side / 2, 0}, {0, 0, 1}, radians));
  for (std::uint32_t i = 0; i + 1 < row; ++i)
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = i * row + j, b = a + row;
      triangles.push_back({a, b, b + 1});
      triangles.push_back({a, b + 1, a + 1});
    }
  return {std::move(points), std::move(triangles)};
}

/// Square dents of side 1 and a depth, side by side: four faces each.
TriangleSet dents(int count, double depth) {
  std::vector<Vec3> points;
  Triangles triangles;
  const auto row = static_cast<std::uint32_t>(count + 1);
  const double middle = count / 2.0;
  for (int i = 0; i <= count; ++i)
    for (int j = 0; j <= count; ++j) points.push_back({i - middle, j - middle, 0});
  for (std::uint32_t i = 0; i + 1 < row; ++i)
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const auto apex = static_cast<std::uint32_t>(points.size());
      points.push_back({i + 0.5 - middle, j + 0.5 - middle, -depth});
      const std::uint32_t a = i * row + j, b = a + row;
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, b + 1), std::pair(b + 1, a + 1), std::pair(a + 1, a)})
        triangles.push_back({p, q, apex});
    }
  return {std::move(points), std::move(triangles)};
}

/// A sphere of 4 n (n - 1) triangles around the origin, turned, with some noise in each coordinate.
TriangleSet sphere(std::uint32_t n, double radius, const Vec3& unit_axis, double radians, double noise = 0) {
  std::vector<Vec3> points;
  Triangles triangles;
  const std::uint32_t m = 2 * n;
  points.push_back({0, 0, radius});
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const double t = std::numbers::pi * i / n, p = 2 * std::numbers::pi * j / m;
      points.push_back(radius * Vec3{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)});
    }
  points.push_back({0, 0, -radius});
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i == 0 ? 0 : i == n ? 1 + (n - 1) * m : 1 + (i - 1) * m + j % m;
  };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      if (i + 1 < n) triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> some(-noise, noise);
  for (Vec3& p : points) p = turned(p, unit_axis, radians) + Vec3{some(random), some(random), some(random)};
  return {std::move(points), std::move(triangles)};
}

double distance_from(const Vec3& point, const TriangleSet& set) {
  const TriangleSet place({point}, {{0, 0, 0}});
  return (*closest_points(place.operand(), set.operand()))->squared_distance.nearest_root();
}

/// A lower bound of it, that takes no rational numbers.
double rounded_distance_from(const Vec3& point, const TriangleSet& set) {
  const TriangleSet place({point}, {{0, 0, 0}});
  return (*distance_range(place.operand(), set.operand(), std::numeric_limits<double>::infinity()))->lower;
}

/// Calls visit(face, point) for points of each face: corners, and of a grid.
template <typename Visit>
void for_each_sample(const TriangleSet& set, int steps, const Visit& visit) {
  for (std::size_t f = 0; f < set.mesh.face_count(); ++f) {
    const TriangleRef t = set.mesh.corners(FaceId(f));
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j)
        visit(FaceId(f), t[0].approx + double(i) / steps * (t[1].approx - t[0].approx) +
                             double(j) / steps * (t[2].approx - t[0].approx));
  }
}

// The point above the apex of a dent is farthest: it is equally far from four faces, by depth / sqrt(1 + (2 depth)^2).
TEST(NearCoincident, AFlatSquareAboveDents) {
  for (const double depth : {0.25, 1e-3, 1e-6, 1e-9})
    for (const int count : {1, 3, 10, 31}) {
      const FarthestPoint point = farthest(square(5, count, 0.3), dents(8, depth));
      const double expected = depth / std::sqrt(1 + 4 * depth * depth), error = expected * 0x1p-29 + 4 * 0x1p-44;
      EXPECT_TRUE(point.is_bounded) << depth << ' ' << count;
      EXPECT_NEAR(distance_of(point), expected, error) << depth << ' ' << count;
      EXPECT_GE(point.upper_bound, expected * (1 - 0x1p-50));
      EXPECT_LE(point.upper_bound, distance_of(point) + error);
    }
}

TEST(NearCoincident, TheSameSquare) {
  const FarthestPoint point = farthest(square(5, 17, 0.3), square(8, 11, 0));
  EXPECT_LE(distance_of(point), 8 * 0x1p-44);
  EXPECT_LE(point.upper_bound, 8 * 0x1p-43);
}

TEST(NearCoincident, TurnedSpheresAgainstSamples) {
  const int steps = is_thorough() ? 12 : 5;
  const Vec3 axis{2.0 / 7, 3.0 / 7, 6.0 / 7};
  for (const double noise : {0.0, 0.02})
    for (const double radians : {0.05, 1.0})
      for (const std::uint32_t other : {5U, 6U, 15U}) {
        const TriangleSet a = sphere(6, 2, axis, 0, noise), b = sphere(other, 2, axis, radians, noise);
        const FarthestPoint point = farthest(a, b);
        double sampled = 0;
        for_each_sample(a, steps,
                        [&](FaceId, const Vec3& p) { sampled = std::max(sampled, rounded_distance_from(p, b)); });
        EXPECT_TRUE(point.is_bounded);
        EXPECT_LE(sampled, point.upper_bound);
        EXPECT_LE(point.upper_bound, distance_of(point) * (1 + 0x1p-29) + 2 * 0x1p-43);
        EXPECT_DOUBLE_EQ(distance_from(point.point.approx(), b), distance_of(point));
        EXPECT_LE(distance_from(point.point.approx(), a), 1e-14);
        EXPECT_LE(distance_of(point), sampled * 1.2);
      }
}

TEST(NearCoincident, DoesNotDependOnThreads) {
  const TriangleSet a = sphere(20, 2, {0, 0, 1}, 0), b = sphere(20, 2, {0.6, 0, 0.8}, 0.4);
  const FarthestPoint parallel = farthest(a, b);
  with_threads(1, [&] {
    const FarthestPoint sequential = farthest(a, b);
    EXPECT_EQ(sequential.point, parallel.point);
    EXPECT_EQ(sequential.nearest, parallel.nearest);
    EXPECT_EQ(sequential.upper_bound, parallel.upper_bound);
  });
}

TEST(NearCoincident, FarFromOneInSize) {
  const double usual = distance_of(farthest(sphere(6, 1, {0, 0, 1}, 0), sphere(7, 1, {0, 0, 1}, 0.1)));
  for (const double size : {0x1p-900, 0x1p-400, 0x1p400, 0x1p1000}) {
    const FarthestPoint point = farthest(sphere(6, size, {0, 0, 1}, 0), sphere(7, size, {0, 0, 1}, 0.1));
    EXPECT_TRUE(point.is_bounded);
    EXPECT_NEAR(distance_of(point) / size, usual, usual * 1e-9);
  }
}

template <typename Vector>
void expect_bounds_with(const TriangleSet& from, const TriangleSet& to, bool is_tight) {
  // Points are doubles, which may be nearly so far off the face.
  const double rounding = std::is_same_v<Vector, Vec3> ? 0 : 0x1p-51;
  const Box3 box = unite(from.hierarchy.bounds(), to.hierarchy.bounds());
  const distances::LargeFacets facets(to.mesh, distances::half_scale_for(box));
  distances::FaceBounds<Vector> bounds(from.mesh, to.operand(), facets, box, 0);
  std::vector<double> upper(from.mesh.face_count()), sampled(from.mesh.face_count());
  for (std::size_t f = 0; f < upper.size(); ++f) {
    const distances::FaceBound bound = bounds.of(FaceId(f), {FaceId(0), FaceId(1), FaceId(2)});
    upper[f] = bound.upper;
    const double at_where = distance_from(bound.where, to);
    EXPECT_LE(at_where, bound.upper + rounding);
    EXPECT_NEAR(at_where, bound.upper, is_tight ? 1e-12 : std::numeric_limits<double>::infinity());
  }
  for_each_sample(from, is_thorough() ? 8 : 3, [&](FaceId f, const Vec3& p) {
    sampled[f.index()] = std::max(sampled[f.index()], rounded_distance_from(p, to));
  });
  for (std::size_t f = 0; f < upper.size(); ++f) EXPECT_LE(sampled[f], upper[f] + rounding);
}

/// Comparisons of parts with triangles for each face, for bounds that exceed the distances of the vertices.
double comparisons_per_face(const TriangleSet& from, const TriangleSet& to) {
  double enough = 0;
  std::vector<FaceId> nearest;
  for (const Vec3& p : from.mesh.points().approx()) {
    const TriangleSet place({p}, {{0, 0, 0}});
    const auto closest = *closest_points(place.operand(), to.operand());
    nearest.push_back(closest->second_face);
    enough = std::max(enough, closest->squared_distance.nearest_root());
  }
  const Box3 box = unite(from.hierarchy.bounds(), to.hierarchy.bounds());
  const distances::LargeFacets facets(to.mesh, distances::half_scale_for(box));
  distances::FaceBounds<Vec3> bounds(from.mesh, to.operand(), facets, box, enough * (1 + 0x1p-30) + 0x1p-43);
  for (std::size_t f = 0; f < from.mesh.face_count(); ++f) {
    const auto [a, b, c] = from.mesh.triangle(FaceId(f));
    bounds.of(FaceId(f), {nearest[a], nearest[b], nearest[c]});
  }
  return static_cast<double>(bounds.comparison_count()) / static_cast<double>(from.mesh.face_count());
}

void expect_bounds(const TriangleSet& from, const TriangleSet& to, bool is_tight) {
  expect_bounds_with<Vec3>(from, to, is_tight);
  expect_bounds_with<WideVec3>(from, to, is_tight);
}

TEST(FaceBounds, WorkDoesNotGrowWhereSetsAreNear) {
  for (const double radians : {1e-3, 1e-6, 1e-9})
    for (const std::uint32_t n : {12U, 24U}) {
      const TriangleSet a = sphere(n, 2, {2.0 / 7, 3.0 / 7, 6.0 / 7}, 0),
                        b = sphere(n, 2, {2.0 / 7, 3.0 / 7, 6.0 / 7}, radians);
      EXPECT_LE(comparisons_per_face(a, b), 300) << radians << ' ' << n;
    }
}

TEST(FaceBounds, OfSurfacesThatNearlyCoincide) {
  expect_bounds(square(5, 3, 0.3), dents(8, 0.01), true);
  expect_bounds(square(5, 9, 0.3), dents(8, 0.01), true);
  expect_bounds(sphere(6, 2, {0, 0, 1}, 0), sphere(9, 2, {0.6, 0, 0.8}, 0.4), false);
  expect_bounds(sphere(5, 2, {0, 0, 1}, 0), sphere(40, 1.9, {0.6, 0, 0.8}, 0.4, 0.01), false);
}

/// The faces of a set, of which no more is known than `at_most`.
std::vector<BoundedFace> all_faces(const TriangleSet& set, double at_most) {
  std::vector<BoundedFace> faces;
  for (std::size_t f = 0; f < set.mesh.face_count(); ++f) faces.push_back({FaceId(f), at_most, FaceId(0)});
  return faces;
}

TriangleSet lifted(const TriangleSet& set, double height) {
  std::vector<Vec3> points;
  for (const Vec3& p : set.mesh.points().approx()) points.push_back(p + Vec3{0, 0, height});
  Triangles triangles;
  for (std::size_t f = 0; f < set.mesh.face_count(); ++f) triangles.push_back(set.mesh.triangle(FaceId(f)));
  return {std::move(points), std::move(triangles)};
}

// Faces that moved along a plane by a whole side, and off it by some spacings of doubles.
TEST(BoundedDistance, IsThatOffTheSet) {
  const TriangleSet plane = square(3, 5, 0.3);
  for (const double height : {0.0, 0x1p-53, 0x1p-50, 0x1p-20}) {
    const TriangleSet off = lifted(square(1, 3, 0.7), height);
    const double bound = *bounded_distance(off.mesh, all_faces(off, 1), plane.operand(), 0);
    EXPECT_GE(bound, height);
    EXPECT_LE(bound, height + 0x1p-56);
    EXPECT_EQ(*bounded_distance(off.mesh, all_faces(off, 1), plane.operand(), 0x1p-10), 0x1p-10);
    EXPECT_EQ(*bounded_distance(off.mesh, all_faces(off, height), plane.operand(), 0), height);
  }
}

// Only one bound of all faces is known, and no face that is near.
TEST(BoundedDistance, FindsNearFacesByItself) {
  const TriangleSet plane = square(3, 5, 0.3);
  for (const double height : {0x1p-53, 0x1p-50, 0x1p-20}) {
    const TriangleSet off = lifted(square(1, 3, 0.7), height);
    const double bound = *bounded_distance(off.mesh, 4 * height, plane.operand(), 0);
    EXPECT_GE(bound, height);
    EXPECT_LE(bound, height + 0x1p-56);
    EXPECT_EQ(*bounded_distance(off.mesh, 4 * height, plane.operand(), 2 * height), 2 * height);
    EXPECT_EQ(*bounded_distance(off.mesh, 4 * height, plane.operand(), 8 * height), 4 * height);
  }
}

// Needles that end in one point, seen by needles that end some spacings of doubles beside it.
TEST(BoundedDistance, BetweenFansOfNeedles) {
  const auto fan = [](int count, const Vec3& tip, double turn) {
    std::vector<Vec3> points = {tip};
    Triangles triangles;
    for (int i = 0; i < count; ++i) {
      const double at = 2 * std::numbers::pi * (i + turn) / count;
      points.push_back({0.04 * std::cos(at), 0.04 * std::sin(at), 0.999});
      const auto a = static_cast<std::uint32_t>(i + 1), b = static_cast<std::uint32_t>((i + 1) % count + 1);
      triangles.push_back({0, a, b});
    }
    return TriangleSet(std::move(points), std::move(triangles));
  };
  const TriangleSet given = fan(160, {0, 0, 1}, 0);
  for (const double aside : {20.0, 100.0, 500.0}) {
    // Moved along the slope of one needle, which is 1 / 40.
    const TriangleSet moved = fan(160, {0x1p-53 * aside, 0, 1}, 0);
    const double bound = *bounded_distance(moved.mesh, all_faces(moved, 0x1p-53 * aside), given.operand(), 0);
    double farthest = 0;
    for_each_sample(moved, is_thorough() ? 6 : 2,
                    [&](FaceId, const Vec3& p) { farthest = std::max(farthest, distance_from(p, given)); });
    EXPECT_GE(bound + 0x1p-54, farthest);  // samples are rounded
    EXPECT_LE(bound, 0x1p-53 * (aside / 20 + 1));
  }
}

TEST(BoundedDistance, EndsWhenItIsCancelled) {
  const std::atomic<bool> cancel = true;
  const TriangleSet plane = square(3, 5, 0.3), off = square(1, 3, 0.7);
  EXPECT_EQ(bounded_distance(off.mesh, all_faces(off, 1), plane.operand(), 0, &cancel).error().code,
            ErrorCode::interrupted);
}

TEST(FaceBounds, OfRandomTriangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0, 1);
  for (int round = 0; round < 20; ++round) {
    // Some share corners, so that edges have one, two or more triangles; some are segments or points.
    const auto draw = [&](std::uint32_t count) {
      std::vector<Vec3> points(count / 2 + 3);
      for (Vec3& p : points) p = {coordinate(random), coordinate(random), 0.2 * coordinate(random)};
      std::uniform_int_distribution<std::uint32_t> corner(0, static_cast<std::uint32_t>(points.size()) - 1);
      Triangles triangles(count);
      for (auto& t : triangles) t = {corner(random), corner(random), corner(random)};
      return TriangleSet(std::move(points), std::move(triangles));
    };
    expect_bounds(draw(6), draw(3 + static_cast<std::uint32_t>(round) * 4), false);
  }
}

}  // namespace
}  // namespace algebra3d
