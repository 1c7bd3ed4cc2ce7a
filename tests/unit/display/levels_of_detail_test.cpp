#include "algebra3d/values/display/levels_of_detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "unit/display/values.h"

namespace algebra3d {
namespace {

TEST(LevelsOfDetail, are_shapes_of_the_value_with_fewer_triangles) {
  const TriangleMesh mesh = unit_sphere(200, 300);
  constexpr std::array<std::size_t, 3> kCounts = {1000000, 20000, 500};
  const auto levels = levels_of_detail(Value::of(Volume3d::trusted(mesh)), kCounts);
  ASSERT_TRUE(levels.ok());
  ASSERT_EQ(levels->size(), 3U);
  EXPECT_EQ((*levels)[0].triangles.size(), mesh.face_count()) << "the whole shape";
  EXPECT_FALSE((*levels)[0].deviation.has_value());
  for (std::size_t i : {1U, 2U}) {
    const DrawnShape& level = (*levels)[i];
    EXPECT_EQ(level.kind, "volume3d");
    EXPECT_EQ(level.triangle_count, mesh.face_count());
    EXPECT_EQ(level.box, (*levels)[0].box);
    EXPECT_EQ(level.origin, (*levels)[0].origin);
    EXPECT_LE(level.triangles.size(), kCounts[i]);
    EXPECT_GE(level.triangles.size(), kCounts[i] / 2);
    EXPECT_NEAR(enclosed_volume(level), 4 * std::numbers::pi / 3, 0.17);
    EXPECT_GT(*level.deviation, 0);
    EXPECT_TRUE(level.boundary.empty() && level.nonmanifold.empty()) << "the sphere has none";
    EXPECT_TRUE(level.face_ids.empty() && level.vertex_ids.empty());
    EXPECT_EQ(level.normals.size(), level.positions.size());
  }
  EXPECT_LT(*(*levels)[1].deviation, *(*levels)[2].deviation);
}

/// A disc far from zero: its boundary becomes one loop of fewer lines, near the circle.
TEST(LevelsOfDetail, boundaries_are_those_of_the_value) {
  std::vector<Vec3> points{{1e6, 0, 0}};
  std::vector<TriangleMesh::Triangle> triangles;
  constexpr std::uint32_t kRings = 40, kColumns = 200;
  for (std::uint32_t i = 1; i <= kRings; ++i)
    for (std::uint32_t j = 0; j < kColumns; ++j) {
      const double angle = 2 * std::numbers::pi * j / kColumns, radius = 1.0 * i / kRings;
      points.push_back({1e6 + radius * std::cos(angle), radius * std::sin(angle), 0});
      const std::uint32_t next = (j + 1) % kColumns, outer = 1 + (i - 1) * kColumns, inner = outer - kColumns;
      if (i == 1) {
        triangles.push_back({0, outer + j, outer + next});
      } else {
        triangles.push_back({inner + j, outer + j, outer + next});
        triangles.push_back({inner + j, outer + next, inner + next});
      }
    }
  const Value disc = Value::of(Surface3d::trusted(TriangleMesh(PointArray(std::move(points)), triangles)));
  const auto levels = levels_of_detail(disc, std::array<std::size_t, 1>{1000});
  ASSERT_TRUE(levels.ok());
  const DrawnShape& level = levels->front();
  ASSERT_GT(level.boundary.size(), 20U);
  ASSERT_LT(level.boundary.size(), 200U);
  double around = 0;
  for (const auto& [a, b] : level.boundary) {
    const Vec3 p = place(level, a) - Vec3{1e6, 0, 0}, q = place(level, b) - Vec3{1e6, 0, 0};
    EXPECT_NEAR(length(p), 1, 0.2);
    around += std::abs(std::atan2(cross(p, q).z, dot(p, q)));
  }
  EXPECT_GT(around, 2 * std::numbers::pi - 1e-6) << "all the way round";
}

/// Grains smaller than any cell leave points.
TEST(LevelsOfDetail, parts_that_vanish_become_points) {
  const TriangleMesh grain = cube_triangles(0, 0.001);
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (int i = 0; i < 1000; ++i) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3& p : grain.points().approx())
      points.push_back(p + Vec3{1.0 * (i % 10), 1.0 * (i / 10 % 10), 1.0 * (i / 100)});
    for (const auto& [a, b, c] : triangles_of(grain)) triangles.push_back({first + a, first + b, first + c});
  }
  const Value value = Value::of(Volume3d::trusted(TriangleMesh(PointArray(std::move(points)), triangles)));
  const auto levels = levels_of_detail(value, std::array<std::size_t, 2>{1200, 200});
  ASSERT_TRUE(levels.ok());
  EXPECT_LE((*levels)[0].triangles.size(), 1200U);
  EXPECT_LE((*levels)[0].points.size(), 1200U);
  EXPECT_GE((*levels)[0].points.size(), 900U);
  EXPECT_LE((*levels)[1].points.size(), 200U);
  EXPECT_GE((*levels)[1].points.size(), 20U);
}

TEST(LevelsOfDetail, of_meshes_with_defects) {
  // Three fine sheets that meet in a line.
  std::string vertices, faces;
  constexpr int kCells = 30;
  int count = 0;
  for (int sheet = 0; sheet < 3; ++sheet)
    for (int i = sheet == 0 ? 0 : 1; i <= kCells; ++i)
      for (int j = 0; j <= kCells; ++j, ++count) {
        const double out = static_cast<double>(i) / kCells, angle = 2 * std::numbers::pi * sheet / 3;
        vertices +=
            fmt::format("({} {} {})", out * std::cos(angle), out * std::sin(angle), static_cast<double>(j) / kCells);
      }
  const auto number = [](int sheet, int i, int j) {
    if (i == 0) return j;
    return (sheet == 0 ? 0 : (kCells + 1) + sheet * kCells * (kCells + 1)) + (sheet == 0 ? i : i - 1) * (kCells + 1) +
           j;
  };
  for (int sheet = 0; sheet < 3; ++sheet)
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j)
        faces += fmt::format("({} {} {} {})", number(sheet, i, j), number(sheet, i + 1, j), number(sheet, i + 1, j + 1),
                             number(sheet, i, j + 1));
  const Value mesh = value_of<Mesh3d>("((" + vertices + ") (" + faces + "))");
  ASSERT_EQ(mesh.get<Mesh3d>().mesh().nonmanifold_edge_count(), static_cast<std::size_t>(kCells));
  const auto levels = levels_of_detail(mesh, std::array<std::size_t, 1>{600});
  ASSERT_TRUE(levels.ok());
  const DrawnShape& level = levels->front();
  EXPECT_EQ(level.triangle_count, 2U * 3 * kCells * kCells);
  EXPECT_GE(level.nonmanifold.size(), 5U);
  EXPECT_LE(level.nonmanifold.size(), 15U);
  for (const auto& line : level.nonmanifold)
    for (const std::uint32_t end : line) {
      const Vec3 p = place(level, end);
      EXPECT_LT(std::hypot(p.x, p.y), 0.15) << "near the common line";
    }
}

TEST(LevelsOfDetail, tell_how_far_they_are) {
  std::vector<int> told;
  const Monitor::Report report = [&](const std::string& text) {
    const std::string before = "levels of detail, ";
    ASSERT_TRUE(text.starts_with(before) && text.ends_with(" %")) << text;
    told.push_back(std::stoi(text.substr(before.size())));
  };
  constexpr std::array<std::size_t, 3> kCounts = {8000, 2000, 500};
  const Value ball = Value::of(Volume3d::trusted(unit_sphere(100, 100)));
  ASSERT_TRUE(levels_of_detail(ball, kCounts, Monitor(nullptr, &report)).ok());
  EXPECT_GE(told.size(), kCounts.size() + 2);
  EXPECT_EQ(told.front(), 0);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_LT(told.back(), 100);
}

TEST(LevelsOfDetail, of_undefined_and_empty_values_are_empty) {
  for (const Type* type : {&TypeOf<Volume3d>::type(), &TypeOf<Surface3d>::type(), &TypeOf<Mesh3d>::type()}) {
    ASSERT_TRUE(has_levels(*type));
    EXPECT_TRUE(levels_of_detail(Value(*type), std::array<std::size_t, 1>{5})->front().is_empty());
  }
  EXPECT_TRUE(levels_of_detail(Value::of(Volume3d()), std::array<std::size_t, 1>{5})->front().is_empty());
  EXPECT_FALSE(has_levels(TypeOf<Points3d>::type()));
}

}  // namespace
}  // namespace algebra3d
