#include "algebra3d/kernel/rounding/detail/snap_rounding.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/autorefinement/winding_selection.h"
#include "algebra3d/kernel/validity/validity.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

// The short side of a slot is moved over the edge of the plate.
TEST(SnapRounding, routes_an_edge_through_a_vertex_that_passed_over_it) {
  SetOperations engine;
  const TriangleMesh slotted = engine.subtract(box({0, 0, 0}, {8, 8, 1}), box({2, 1, -1}, {3, 4, 2}));
  MovedVertices moved;
  for (const Vec3& p : slotted.points().approx()) {
    moved.points.push_back(p.y == 1 ? Vec3{p.x, -0.125, p.z} : p);
    moved.movements.push_back(p.y == 1 ? 1.125 : 0);
  }
  const SnappedMesh snapped = *snap_round(slotted, moved);
  EXPECT_EQ(snapped.largest_detour, 0.125);
  EXPECT_EQ(prove_surface(snapped.mesh)->text().find("boundary edge"), std::string::npos);
  // The slot is 1 x 4 now, and open to the side up to what the triangles of the bent side cut off.
  const TriangleMesh solid = *solid_by_winding(snapped.mesh, [](int winding) { return winding > 0; });
  EXPECT_EQ(prove_volume(solid)->text(), "");
  EXPECT_NEAR(exact_volume_of(solid).nearest_double(), 64 - 4 + 8 * 0.125 / 2, 0.5);
}

TEST(SnapRounding, of_what_has_not_moved_is_itself) {
  const TriangleMesh sphere = geodesic_sphere(3);
  const SnappedMesh snapped = *snap_round(sphere, {sphere.points(), std::vector<double>(sphere.vertex_count())});
  EXPECT_EQ(exact_volume_of(snapped.mesh), exact_volume_of(sphere));
  EXPECT_EQ(snapped.mesh.face_count(), sphere.face_count());
  EXPECT_EQ(snapped.largest_detour, 0);
}

// Whatever the vertices do, every edge keeps its two sides.
TEST(SnapRounding, stays_closed_however_vertices_move) {
  for (std::uint64_t seed = 1; seed <= rounds(15U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SetOperations engine;
    RandomSolids random(seed, engine);
    const TriangleMesh solid = engine.unite(random.operand(), random.operand());
    Chance chance(seed);
    double size = 0;
    for (const Vec3& p : solid.points().approx()) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    MovedVertices moved;
    for (const Vec3& p : solid.points().approx()) {
      const double reach = size * (chance.one_in(3) ? 0.2 : 1e-14);
      const Vec3 by{reach * chance.unit(), reach * chance.unit(), reach * chance.unit()};
      moved.points.push_back(p + by);
      moved.movements.push_back(std::sqrt(dot(by, by)));
    }
    // Windings are those of a closed mesh only if it is one.
    const SnappedMesh snapped = *snap_round(solid, moved);
    const ValidityReport report = *prove_surface(snapped.mesh);
    EXPECT_EQ(report.text().find("boundary edge"), std::string::npos) << report.text();
    EXPECT_TRUE(solid_by_winding(snapped.mesh, [](int winding) { return winding > 0; }).ok());
  }
}

/// The places of the corners of all triangles; ascending.
std::vector<std::array<Vec3, 3>> corners_of(const TriangleMesh& mesh) {
  std::vector<std::array<Vec3, 3>> corners;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.corners(FaceId(f));
    corners.push_back({a.approx, b.approx, c.approx});
  }
  std::ranges::sort(corners);
  return corners;
}

// Both diagonals of the upper side of a cube that moves a little; the sweep would choose one of them.
TEST(SnapRounding, keeps_triangles_that_do_not_turn_over) {
  for (const bool is_other : {false, true}) {
    std::vector<IndexTriangle> triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6},
                                            {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    if (is_other)
      triangles.insert(triangles.end(), {{4, 5, 7}, {5, 6, 7}});
    else
      triangles.insert(triangles.end(), {{4, 5, 6}, {4, 6, 7}});
    const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const TriangleMesh cube(PointArray(corners), triangles);
    MovedVertices moved{PointArray(corners), std::vector<double>(8)};
    std::vector<Vec3> places = corners;
    for (std::size_t v = 4; v < 8; ++v) {
      places[v].z += v % 2 == 0 ? 0x1p-20 : 0;
      moved.movements[v] = 0x1p-20;
    }
    moved.points = PointArray(places);
    const SnappedMesh snapped = *snap_round(cube, moved);
    EXPECT_EQ(corners_of(snapped.mesh), corners_of(TriangleMesh(PointArray(places), triangles)));
  }
}

TEST(SnapRounding, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  const TriangleMesh sphere = geodesic_sphere(2);
  const auto snapped = snap_round(sphere, {sphere.points(), std::vector<double>(sphere.vertex_count())}, &cancel);
  ASSERT_FALSE(snapped.ok());
  EXPECT_EQ(snapped.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::solids
