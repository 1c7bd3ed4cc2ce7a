#include "algebra3d/kernel/rounding/detail/coplanar_snapping.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "algebra3d/kernel/autorefinement/winding_selection.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/snap_rounding.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

// Two plates a hair apart, crosswise: no vertex of one lies over the other.
TEST(CoplanarSnapping, brings_facets_into_one_plane) {
  SetOperations engine;
  const double hair = 0x1p-40;
  const TriangleMesh crosswise = engine.unite(box({-5, -1, 0}, {5, 1, 1}), box({-1, -5, 1 + hair}, {1, 5, 2}));
  const MovedVertices moved = snap_coplanar(crosswise, std::vector<bool>(crosswise.vertex_count(), true), 2 * hair);
  const TriangleMesh together =
      *solid_by_winding(snap_round(crosswise, moved)->mesh, [](int winding) { return winding > 0; });
  EXPECT_EQ(prove_volume(together)->text(), "");
  EXPECT_EQ(connected_components(crosswise).count, 2U);
  EXPECT_EQ(connected_components(together).count, 1U);
  EXPECT_TRUE(std::ranges::all_of(moved.movements, [&](double movement) { return movement <= hair; }));
}

TEST(CoplanarSnapping, leaves_facets_apart_beyond_the_reach) {
  SetOperations engine;
  const TriangleMesh apart = engine.unite(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 1.5}, {1, 1, 2}));
  const MovedVertices moved = snap_coplanar(apart, std::vector<bool>(apart.vertex_count(), true), 0.25);
  EXPECT_TRUE(std::ranges::all_of(moved.movements, [](double movement) { return movement == 0; }));
}

}  // namespace
}  // namespace algebra3d::solids
