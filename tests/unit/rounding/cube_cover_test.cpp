// The rungs of the ladder that are hardly ever reached, called directly.
#include <array>
#include <atomic>
#include <string>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/met_cells.h"
#include "algebra3d/kernel/rounding/detail/rounding_rungs.h"
#include "algebra3d/kernel/rounding/detail/solid_part.h"
#include "algebra3d/kernel/rounding/detail/solid_rounding.h"
#include "algebra3d/kernel/rounding/detail/square_cover.h"
#include "algebra3d/kernel/validity/validity.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/distances.h"
#include "unit/rounding/faults_by_cgal.h"

namespace algebra3d::solids {
namespace {

constexpr std::size_t kBudget = 1000;

void expect_cover_of(const TriangleMesh& solid, const CoordinateGrid& grid) {
  const auto cover = cover_of_cubes(solid, grid, kBudget, nullptr);
  ASSERT_TRUE(cover.ok() && *cover);
  const TriangleMesh& mesh = (*cover)->mesh;
  EXPECT_FALSE(mesh.is_empty());
  EXPECT_EQ(prove_volume(mesh)->text(), "");
  const Faults faults = faults_of(mesh);
  EXPECT_EQ(faults.degenerate + faults.improper_pairs + faults.unbalanced_edges + faults.points_inside, 0);
  EXPECT_TRUE(SetOperations().subtract(solid, mesh).is_empty());
  for (const Vec3& p : mesh.points().approx())
    EXPECT_EQ(p, (Vec3{grid.nearest(p.x), grid.nearest(p.y), grid.nearest(p.z)}));
  // A few triangles, for speed.
  const std::vector<FaceId> some = {FaceId(0), FaceId(mesh.face_count() / 2), FaceId(mesh.face_count() - 1)};
  expect_near(submesh(mesh, some), solid, (*cover)->movement.distance);
}

TEST(CubeCover, of_random_solids_is_valid_and_near_and_contains_them) {
  const std::array<CoordinateGrid, 3> grids = {CoordinateGrid::doubles(), CoordinateGrid::floats(),
                                               CoordinateGrid::multiples(0.3)};
  for (std::uint64_t seed = 1; seed <= rounds(9U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SetOperations engine;
    RandomSolids random(seed, engine);
    const TriangleMesh solid = engine.subtract(random.operand(), random.operand());
    if (!solid.is_empty()) expect_cover_of(solid, grids[seed % grids.size()]);
  }
}

TEST(CubeCover, keeps_cavities_as_far_as_the_cubes_leave_room) {
  const TriangleMesh hollow = SetOperations().subtract(box({0, 0, 0}, {16, 16, 16}), box({4, 4, 4}, {12, 12, 12}));
  const auto cover = cover_of_cubes(hollow, CoordinateGrid::multiples(1), 5000, nullptr);
  ASSERT_TRUE(cover.ok() && *cover);
  // The cubes inside the cavity that touch its boundary belong to the cover.
  EXPECT_EQ(exact_volume_of((*cover)->mesh), Rational(16 * 16 * 16 - 6 * 6 * 6));
}

TEST(CubeCover, works_at_the_ends_of_the_range) {
  for (const double size : {0x1p-1070, 1e-300, 1e300, 0x1.8p1023, std::numeric_limits<double>::max()}) {
    SCOPED_TRACE(size);
    const TriangleMesh solid = box({-size, -size, -size}, {size, 0, size / 2});
    const auto cover = cover_of_cubes(solid, CoordinateGrid::doubles(), kBudget, nullptr);
    ASSERT_TRUE(cover.ok() && *cover);
    EXPECT_EQ(prove_volume((*cover)->mesh)->text(), "");
    EXPECT_TRUE(SetOperations().subtract(solid, (*cover)->mesh).is_empty());
  }
  // Here determinants of the points from which upward rays start reach the end of the range.
  const Vec3 size = std::ldexp(1.0, 341) * Vec3{3, 4, 5};
  const TriangleMesh solid = mapped(geodesic_sphere(2), [&](const Vec3& p) {
    return Vec3{size.x * p.x, size.y * p.y, size.z * p.z};
  });
  const auto cover = cover_of_cubes(solid, CoordinateGrid::multiples(std::ldexp(0.03, 341)), 10 * kBudget, nullptr);
  EXPECT_EQ(prove_volume((*cover)->mesh)->text(), "");
  const double beyond = 2 * static_cast<double>(std::numeric_limits<float>::max());
  EXPECT_FALSE(*cover_of_cubes(box({0, 0, 0}, {beyond, 1, 1}), CoordinateGrid::floats(), kBudget, nullptr));
}

TEST(CubeCover, is_as_fine_as_the_grid_and_the_budget_allow) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  const double diagonal = std::sqrt(3.0);
  const auto movement = [&](double step, std::size_t budget) {
    return (*cover_of_cubes(cube, CoordinateGrid::multiples(step), budget, nullptr))->movement.distance;
  };
  EXPECT_NEAR(movement(3, kBudget), 3 * diagonal, 1e-9);
  EXPECT_NEAR(movement(0.125, kBudget), 0.125 * diagonal, 1e-9);    // 8 cubes long: 296 at the boundary
  EXPECT_NEAR(movement(0x1p-20, kBudget), 0.125 * diagonal, 1e-9);  // 16 long: 1352
  EXPECT_NEAR(movement(0x1p-20, 2000), 0.0625 * diagonal, 1e-9);
}

TEST(CubeCover, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(cover_of_cubes(box({0, 0, 0}, {1, 1, 1}), CoordinateGrid::doubles(), kBudget, &cancel).error().code,
            ErrorCode::interrupted);
}

TEST(SquareCover, of_random_surfaces_is_valid_and_near) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SetOperations engine;
    RandomSolids random(seed, engine);
    const TriangleMesh solid = random.operand();
    if (solid.is_empty()) continue;
    const auto met = finest_met_cells(solid, CoordinateGrid::floats(), kBudget, nullptr);
    ASSERT_TRUE(met.ok() && *met);
    const auto cover = square_cover(solid, **met, nullptr);
    ASSERT_TRUE(cover.ok());
    EXPECT_FALSE(cover->is_empty());
    EXPECT_EQ(prove_surface(*cover)->text(), "");
    const std::vector<FaceId> some = {FaceId(0), FaceId(cover->face_count() / 2), FaceId(cover->face_count() - 1)};
    expect_near(submesh(*cover, some), solid, (*met)->lattice.diagonal());
  }
}

TEST(SquareCover, follows_a_plane_and_keeps_what_is_smaller_than_a_cell) {
  const auto cover_of = [](const std::vector<Vec3>& corners, const CoordinateGrid& grid) {
    const TriangleMesh surface(PointArray(corners), std::vector<TriangleMesh::Triangle>{{0, 1, 2}});
    return *square_cover(surface, **finest_met_cells(surface, grid, kBudget, nullptr), nullptr);
  };
  // In the plane z = 0.25 of cells of edge 1: only vertical lines between centres could be divided, and none is.
  EXPECT_FALSE(cover_of({{0, 0, 0.25}, {4, 0, 0.25}, {0, 4, 0.25}}, CoordinateGrid::multiples(1)).is_empty());
  // The plane x = 4 lies between columns of centres: 1.5 squares of 8 by 8 are met; those whose centres it divides.
  const TriangleMesh wall = cover_of({{4, 0, 0}, {4, 8, 0}, {4, 0, 8}}, CoordinateGrid::multiples(1));
  EXPECT_EQ(prove_surface(wall)->text(), "");
  const TriangleMesh small =
      cover_of({{0.1, 0.1, 0.1}, {0.2, 0.1, 0.1}, {0.1, 0.2, 0.1}}, CoordinateGrid::multiples(1));
  EXPECT_EQ(small.face_count(), 2U);
}

}  // namespace
}  // namespace algebra3d::solids
