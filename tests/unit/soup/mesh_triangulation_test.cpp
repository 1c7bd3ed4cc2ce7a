#include "algebra3d/kernel/soup/mesh_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

using Outline = std::vector<RationalVec3>;
using Numbers = std::vector<std::vector<std::uint32_t>>;

PolygonMesh mesh_of(const std::vector<Outline>& polygons) {
  PointArray points;
  LargeVector<std::uint32_t> starts{0}, corners;
  for (const Outline& polygon : polygons) {
    for (const RationalVec3& corner : polygon) {
      corners.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(ExactPoint(corner));
    }
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  return {std::move(points), PolygonLayout(std::move(starts)), std::move(corners)};
}

/// The vertices of the triangles.
Numbers triangles_of(const PolygonMesh& mesh) {
  const auto triangles = triangulate_faces(mesh);
  EXPECT_TRUE(triangles.ok());
  Numbers numbers;
  for (const auto& [a, b, c] : *triangles)
    numbers.push_back({mesh.origin(a).index(), mesh.origin(b).index(), mesh.origin(c).index()});
  return numbers;
}

RationalVec3 vector_area(const Outline& polygon) {
  RationalVec3 sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum = sum + cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum;
}

/// n - 2 triangles of positive area that add up to that of the polygon, exactly: so they do not overlap.
void expect_partition(const Outline& polygon) {
  const Numbers triangles = triangles_of(mesh_of({polygon}));
  ASSERT_EQ(triangles.size() + 2, polygon.size());
  const RationalVec3 whole = vector_area(polygon);
  RationalVec3 sum;
  for (const auto& t : triangles) {
    const RationalVec3 area = vector_area({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
    ASSERT_GT(dot(area, whole).sign(), 0);
    sum = sum + area;
  }
  ASSERT_EQ(sum, whole);
}

/// A polygon that is star-shaped about the origin of the plane spanned by u and w, with dents and straight angles.
Outline random_star(std::mt19937& random, const RationalVec3& u, const RationalVec3& w, bool exact) {
  const auto pieces = static_cast<int>(4 + random() % 12);
  Outline polygon;
  for (int i = 0; i < pieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / pieces, radius = 1 + static_cast<double>(random() % 5);
    const Rational third = exact ? Rational(1, 3) : Rational(1);
    const Rational a = Rational(std::round(64 * radius * std::cos(angle))) * third;
    const Rational b = Rational(std::round(64 * radius * std::sin(angle))) * third;
    const RationalVec3 corner = a * u + b * w;
    if (!polygon.empty() && random() % 4 == 0) polygon.push_back(Rational(1, 2) * (polygon.back() + corner));
    polygon.push_back(corner);
  }
  return polygon;
}

TEST(MeshTriangulation, flat_faces_are_divided_exactly_in_their_plane) {
  std::mt19937 random(11);
  const std::vector<RationalVec3> directions{
      {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}, {3, -1, 2}, {1, 1, Rational(1, 8)}, {-1, Rational(1, 4), 5}};
  for (int round = 0; round < 300; ++round) {
    const RationalVec3& u = directions[random() % directions.size()];
    const RationalVec3& w = directions[random() % directions.size()];
    if (is_zero(cross(u, w))) continue;
    Outline polygon = random_star(random, u, w, round % 3 == 0);
    if (round % 2 == 0) std::ranges::reverse(polygon);
    std::ranges::rotate(polygon, polygon.begin() + static_cast<std::ptrdiff_t>(random() % polygon.size()));
    expect_partition(polygon);
    if (HasFailure()) return;
  }
}

TEST(MeshTriangulation, a_thin_face_whose_rounded_normal_says_nothing_is_divided) {
  // Far away and 2^-52 wide: the rounded cross products cancel.
  const Rational far(1e9), tiny(0x1p-52);
  expect_partition({{far, far, far},
                    {far + Rational(1), far, far},
                    {far + Rational(2), far + tiny, far},
                    {far + Rational(1), far + tiny * Rational(1, 2), far}});
}

TEST(MeshTriangulation, convex_faces_become_fans_and_triangles_stay) {
  const PolygonMesh mesh = mesh_of({{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}},
                                    {{0, 0, 0}, {2, 0, 0}, {3, 2, 1}, {1, 3, 0}, {0, 2, 0}},
                                    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  EXPECT_EQ(triangles_of(mesh), (Numbers{{0, 1, 2}, {3, 4, 5}, {3, 5, 6}, {3, 6, 7}, {8, 9, 10}}));
}

TEST(MeshTriangulation, is_the_same_at_both_ends_of_the_range) {
  const std::vector<Vec3> corners{{0, 0, 0}, {0, 4, 1}, {0, 5, 5}, {0, 1, 4}, {0, 2, 2}};
  Numbers expected;
  for (const double scale : {1.0, 0x1p1020, 0x1p600, 0x1p-600, 0x1p-1074}) {
    std::vector<Vec3> scaled;
    for (const Vec3& corner : corners) scaled.push_back(scale * corner);
    const PolygonMesh mesh(PointArray(scaled), PolygonLayout::of_degree(5), {0, 1, 2, 3, 4});
    if (expected.empty()) expected = triangles_of(mesh);
    EXPECT_EQ(triangles_of(mesh), expected);
    EXPECT_EQ(expected.size(), 3U);
  }
}

TEST(MeshTriangulation, a_dent_at_the_first_corner_is_no_fan) {
  EXPECT_EQ(triangles_of(mesh_of({{{1, 0, 0}, {4, -1, 0}, {0, 0, 0}, {4, 1, 0}}})).size(), 2U);
  expect_partition({{1, 0, 0}, {4, 1, 0}, {0, 0, 0}, {4, -1, 0}});
  expect_partition({{0, 0, 0}, {4, -1, 0}, {1, 0, 0}, {4, 1, 0}});
}

TEST(MeshTriangulation, faces_that_cross_themselves_keep_their_corners) {
  const Numbers triangles = triangles_of(mesh_of({{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}}));
  ASSERT_EQ(triangles.size(), 2U);
  std::vector<std::uint32_t> corners;
  for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::ranges::sort(corners);
  corners.erase(std::ranges::unique(corners).begin(), corners.end());
  EXPECT_EQ(corners, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(MeshTriangulation, repeated_corners_do_not_count) {
  PointArray points(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const PolygonMesh mesh(points, PolygonLayout(LargeVector<std::uint32_t>{0, 6, 10, 13}),
                         LargeVector<std::uint32_t>{0, 0, 1, 2, 3, 0, 1, 1, 2, 2, 0, 0, 1});
  EXPECT_EQ(triangles_of(mesh), (Numbers{{0, 1, 2}, {0, 2, 3}, {0, 0, 1}}));
}

TEST(MeshTriangulation, stops_when_cancelled) {
  const std::atomic<bool> cancel = true;
  const auto triangles = triangulate_faces(mesh_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), Monitor(&cancel));
  ASSERT_FALSE(triangles.ok());
  EXPECT_EQ(triangles.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
