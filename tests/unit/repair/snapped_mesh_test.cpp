#include "algebra3d/repair/snapped_mesh.h"

#include <gtest/gtest.h>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/edge_chains.h"
#include "algebra3d/repair/pressed_sheets.h"
#include "algebra3d/repair/winding_solid.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

TEST(EdgeChains, are_led_through_vertices_in_the_order_along_the_edge) {
  const std::vector<Vec3> points{{0, 0, 0}, {10, 0, 0}, {7, 1, 0}, {3, 2, 0}, {-1, 0, 0}};
  EdgeChains edges(points);
  const std::uint32_t edge = edges.add(0, 1);
  EXPECT_EQ(edges.distance({edge, 0}, 2), 1);
  EXPECT_TRUE(std::isinf(edges.distance({edge, 0}, 4)));
  EXPECT_TRUE(std::isinf(edges.distance({edge, 0}, 0)));
  edges.lead_through({edge, 0}, 2);
  edges.lead_through({edge, 0}, 3);
  edges.lead_through({edge, 0}, 2);
  EXPECT_EQ(edges.apply(), std::vector<std::uint32_t>{edge});
  EXPECT_EQ(std::vector(edges[edge].begin(), edges[edge].end()), (std::vector<std::uint32_t>{0, 3, 2, 1}));
  EXPECT_EQ(edges.largest_detour(), 2);
  EXPECT_TRUE(edges.apply().empty());
}

// The short side of a slot is moved over the edge of the plate.
TEST(SnappedMesh, leads_an_edge_through_a_vertex_that_passed_over_it) {
  SetOperations engine;
  const TriangleMesh slotted = engine.subtract(box({0, 0, 0}, {8, 8, 1}), box({2, 1, -1}, {3, 4, 2}));
  MovedVertices moved;
  for (const Vec3& p : slotted.points().approx()) {
    moved.points.push_back(p.y == 1 ? Vec3{p.x, -0.125, p.z} : p);
    moved.movements.push_back(p.y == 1 ? 1.125 : 0);
  }
  const SnappedMesh snapped = snapped_mesh(slotted, moved);
  EXPECT_EQ(snapped.largest_detour, 0.125);
  EXPECT_EQ(prove_surface(snapped.mesh)->text().find("boundary edge"), std::string::npos);
  // The slot is 1 x 4 now, and open to the side up to what the triangles of the bent side cut off.
  const TriangleMesh solid = *winding_solid(snapped.mesh, [](int winding) { return winding > 0; });
  EXPECT_EQ(prove_volume(solid)->text(), "");
  EXPECT_NEAR(exact_volume_of(solid).nearest_double(), 64 - 4 + 8 * 0.125 / 2, 0.5);
}

TEST(SnappedMesh, of_what_has_not_moved_is_itself) {
  const TriangleMesh sphere = geodesic_sphere(3);
  const SnappedMesh snapped = snapped_mesh(sphere, {sphere.points(), std::vector<double>(sphere.vertex_count())});
  EXPECT_EQ(exact_volume_of(snapped.mesh), exact_volume_of(sphere));
  EXPECT_EQ(snapped.mesh.face_count(), sphere.face_count());
  EXPECT_EQ(snapped.largest_detour, 0);
}

// Whatever the vertices do, every edge keeps its two sides.
TEST(SnappedMesh, stays_closed_however_vertices_move) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
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
    const SnappedMesh snapped = snapped_mesh(solid, moved);
    const ValidityReport report = *prove_surface(snapped.mesh);
    EXPECT_EQ(report.text().find("boundary edge"), std::string::npos) << report.text();
    EXPECT_TRUE(winding_solid(snapped.mesh, [](int winding) { return winding > 0; }).ok());
  }
}

// Two plates a hair apart, crosswise: no vertex of one lies over the other.
TEST(PressedSheets, come_into_one_plane) {
  SetOperations engine;
  const double hair = 0x1p-40;
  const TriangleMesh crosswise = engine.unite(box({-5, -1, 0}, {5, 1, 1}), box({-1, -5, 1 + hair}, {1, 5, 2}));
  const MovedVertices pressed = pressed_sheets(crosswise, std::vector<bool>(crosswise.vertex_count(), true), 2 * hair);
  const TriangleMesh together =
      *winding_solid(snapped_mesh(crosswise, pressed).mesh, [](int winding) { return winding > 0; });
  EXPECT_EQ(prove_volume(together)->text(), "");
  EXPECT_EQ(connected_components(crosswise).count, 2U);
  EXPECT_EQ(connected_components(together).count, 1U);
  EXPECT_TRUE(std::ranges::all_of(pressed.movements, [&](double movement) { return movement <= hair; }));
}

TEST(PressedSheets, stay_apart_beyond_the_reach) {
  SetOperations engine;
  const TriangleMesh apart = engine.unite(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 1.5}, {1, 1, 2}));
  const MovedVertices pressed = pressed_sheets(apart, std::vector<bool>(apart.vertex_count(), true), 0.25);
  EXPECT_TRUE(std::ranges::all_of(pressed.movements, [](double movement) { return movement == 0; }));
}

}  // namespace
}  // namespace algebra3d::solids
