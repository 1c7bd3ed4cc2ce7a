#include "algebra3d/kernel/rounding/rounded_surface.h"

#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/validity/validity.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/mesh_area.h"

namespace algebra3d::solids {
namespace {

TriangleMesh both_surfaces(const TriangleMesh& a, const TriangleMesh& b) {
  return combine_surfaces({&a}, {&b}, SurfaceRule::either).value();
}

TEST(RoundedSurface, of_doubles_is_itself) {
  const TriangleMesh sphere = geodesic_sphere(3);
  const auto rounded = rounded_surface(sphere, CoordinateGrid::doubles());
  ASSERT_TRUE(rounded.ok() && rounded->mesh);
  EXPECT_EQ(triangles_of(*rounded->mesh), triangles_of(sphere));
  EXPECT_EQ(rounded->moved_vertices, 0U);
}

TEST(RoundedSurface, of_crossing_surfaces_is_valid_with_nearly_the_same_area) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SetOperations engine;
    RandomSolids random(seed, engine);
    const TriangleMesh surface = both_surfaces(random.operand(), random.operand());
    for (const CoordinateGrid& grid : {CoordinateGrid::doubles(), CoordinateGrid::floats()}) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const auto rounded = rounded_surface(surface, grid);
      ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
      EXPECT_EQ(prove_surface(*rounded->mesh)->text(), "");
      EXPECT_EQ(rounded_surface(*rounded->mesh, grid)->moved_vertices, 0U);
      const double area = area_of(surface);
      // Far from the origin floats are coarse. Walls a hair apart become one.
      const bool is_fine = grid.spacing_up_to(largest_coordinate(surface)) < 1e-6 * std::sqrt(area);
      EXPECT_LE(area_of(*rounded->mesh), (is_fine ? 1.0001 : 2) * area);
      if (is_fine) {
        EXPECT_GE(area_of(*rounded->mesh), 0.9 * area);
      }
    }
  }
}

TEST(RoundedSurface, to_a_coarse_grid_is_valid) {
  for (std::uint64_t seed = 1; seed <= rounds(6U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TriangleMesh sphere = geodesic_sphere(5);
    Chance chance(seed);
    const Vec3 shift{chance.unit(), chance.unit(), chance.unit()};
    const TriangleMesh surface = both_surfaces(sphere, mapped(sphere, [&](const Vec3& p) { return p + shift; }));
    const CoordinateGrid grid = CoordinateGrid::multiples(0.02 * static_cast<double>(1 + 5 * seed % 12));
    const auto rounded = rounded_surface(surface, grid);
    ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
    EXPECT_EQ(prove_surface(*rounded->mesh)->text(), "");
    EXPECT_EQ(rounded_surface(*rounded->mesh, grid)->moved_vertices, 0U);
  }
}

/// Triangles as a mesh with a corner of its own for each.
TriangleMesh sheets(const std::vector<Vec3>& corners) {
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < corners.size(); i += 3) triangles.push_back({i, i + 1, i + 2});
  return {PointArray(corners), triangles};
}

/// The union of triangles that cross.
TriangleMesh united_sheets(const std::vector<std::vector<Vec3>>& triangles) {
  std::vector<TriangleMesh> meshes;
  for (const std::vector<Vec3>& corners : triangles) meshes.push_back(sheets(corners));
  std::vector<Operand> operands;
  for (const TriangleMesh& mesh : meshes) operands.push_back({&mesh, 0});
  return unite_surfaces(operands).value();
}

/// A surface and a copy of it that is turned by a small angle about an axis which is not parallel to any coordinate
/// plane.
TriangleMesh with_turned_copy(const TriangleMesh& surface, double degrees) {
  const auto map = AffineMap::rotation(RationalVec3(Vec3{0, 0, 0}), RationalVec3(Vec3{1, 2, 3}), degrees);
  PointArray points;
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) points.push_back(map->apply_rounded(surface.points()[v]));
  const TriangleMesh turned(std::move(points), triangles_of(surface));
  return both_surfaces(surface, turned);
}

void expect_rounded_nearby(const TriangleMesh& surface, const CoordinateGrid& grid) {
  const auto rounded = rounded_surface(surface, grid);
  ASSERT_TRUE(rounded.ok() && rounded->mesh);
  EXPECT_EQ(prove_surface(*rounded->mesh)->text(), "");
  EXPECT_LE(rounded->mesh->face_count(), 2 * surface.face_count());
  EXPECT_LE(rounded->largest_movement, 64 * grid.spacing_up_to(largest_coordinate(surface)));
}

// Where one sheet ended within another one, rounding forgot the edge in which they meet: so nearly coplanar triangles
// crossed all along it, features were joined within 2^20 spacings, and triangles multiplied.
TEST(RoundedSurface, of_sheets_and_a_copy_turned_by_a_hair_moves_by_a_hair) {
  const TriangleMesh two = united_sheets({{{1, -1, 1}, {0, 1, 0}, {1, 2, 2}}, {{0, 0, 3}, {3, 1, 2}, {1, 2, -3}}});
  const TriangleMesh three = united_sheets(
      {{{0, 3, 3}, {1, 0, 3}, {1, 2, 2}}, {{1, 2, 1}, {-3, -2, -3}, {0, 3, 2}}, {{0, 3, 3}, {3, 3, 0}, {0, -3, 3}}});
  const TriangleMesh others = united_sheets({{{2, -1, -2}, {1, 2, 2}, {1, -1, 1}},
                                             {{1, 1, -2}, {-1, -3, 1}, {-2, -1, 3}},
                                             {{3, -1, 1}, {-2, 3, -2}, {3, -1, 0}}});
  expect_rounded_nearby(with_turned_copy(two, 1e-7), CoordinateGrid::doubles());
  expect_rounded_nearby(with_turned_copy(three, 1e-10), CoordinateGrid::doubles());
  expect_rounded_nearby(with_turned_copy(others, 1e-7), CoordinateGrid::doubles());
}

TEST(RoundedSurface, sheets_that_come_to_lie_upon_each_other_become_one) {
  const TriangleMesh two = sheets({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 0.25}, {0, 8, 0.25}, {8, 0, 0.25}});
  const auto rounded = rounded_surface(two, CoordinateGrid::multiples(1));
  ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
  EXPECT_EQ(area_of(*rounded->mesh), 32);
  EXPECT_EQ(prove_surface(*rounded->mesh)->text(), "");
}

// An edge led round the third corner, which lies within the movements of both, would close the triangle.
TEST(RoundedSurface, vertices_are_moved_before_edges_are_led_on_a_grid_of_multiples) {
  const auto rounded = rounded_surface(sheets({{0, 0, 0.4}, {1, 0, 0.4}, {0, 1, 0.4}}), CoordinateGrid::multiples(1));
  ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
  EXPECT_EQ(area_of(*rounded->mesh), 0.5);
  EXPECT_EQ(rounded->method, RoundingMethod::vertices_moved);
}

TEST(RoundedSurface, ends_when_it_is_cancelled) {
  const std::atomic<bool> cancel = true;
  const TriangleMesh surface = with_turned_copy(united_sheets({{{1, -1, 1}, {0, 1, 0}, {1, 2, 2}}}), 1e-7);
  EXPECT_EQ(rounded_surface(surface, CoordinateGrid::floats(), &cancel).error().code, ErrorCode::interrupted);
}

TEST(RoundedSurface, thinner_than_the_grid_vanishes_and_out_of_range_has_a_reason) {
  const TriangleMesh needle = sheets({{0.1, 0, 0}, {0.2, 0, 0}, {0.1, 9, 0}});
  EXPECT_TRUE(rounded_surface(needle, CoordinateGrid::multiples(1))->mesh->is_empty());
  const TriangleMesh far = sheets({{0, 0, 0}, {1e300, 0, 0}, {0, 1, 0}});
  EXPECT_TRUE(
      rounded_surface(far, CoordinateGrid::floats())->reason.ends_with("the numbers end at 3.4028234663852886e+38"));
}

// The first triangle does not move; the needle moved by a fifth before it vanished.
TEST(RoundedSurface, the_distance_is_that_of_what_remains) {
  const TriangleMesh both = sheets({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {8.125, 0, 0}, {8.25, 0, 0}, {8.125, 9, 0}});
  const auto rounded = rounded_surface(both, CoordinateGrid::multiples(1));
  EXPECT_EQ(rounded->mesh->face_count(), 1U);
  EXPECT_EQ(rounded->moved_vertices, 3U);
  EXPECT_EQ(rounded->largest_movement, 0);
}

}  // namespace
}  // namespace algebra3d::solids
