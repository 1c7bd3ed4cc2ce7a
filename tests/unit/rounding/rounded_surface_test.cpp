#include "algebra3d/rounding/rounded_surface.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "algebra3d/arrangement/surface_arrangement.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/validity/validity.h"
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
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TriangleMesh sphere = geodesic_sphere(5);
    Chance chance(seed);
    const Vec3 shift{chance.unit(), chance.unit(), chance.unit()};
    const TriangleMesh surface = both_surfaces(sphere, mapped(sphere, [&](const Vec3& p) { return p + shift; }));
    const CoordinateGrid grid = CoordinateGrid::multiples(0.02 * static_cast<double>(1 + seed % 12));
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

TEST(RoundedSurface, sheets_that_come_to_lie_upon_each_other_become_one) {
  const TriangleMesh two = sheets({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 0.25}, {0, 8, 0.25}, {8, 0, 0.25}});
  const auto rounded = rounded_surface(two, CoordinateGrid::multiples(1));
  ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
  EXPECT_EQ(area_of(*rounded->mesh), 32);
  EXPECT_EQ(prove_surface(*rounded->mesh)->text(), "");
}

TEST(RoundedSurface, thinner_than_the_grid_vanishes_and_out_of_range_has_a_reason) {
  const TriangleMesh needle = sheets({{0.1, 0, 0}, {0.2, 0, 0}, {0.1, 9, 0}});
  EXPECT_TRUE(rounded_surface(needle, CoordinateGrid::multiples(1))->mesh->is_empty());
  const TriangleMesh far = sheets({{0, 0, 0}, {1e300, 0, 0}, {0, 1, 0}});
  EXPECT_STREQ(rounded_surface(far, CoordinateGrid::floats())->reason, "a coordinate is out of range");
}

}  // namespace
}  // namespace algebra3d::solids
