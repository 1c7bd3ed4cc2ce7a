// No identifier of a triangulation of the plane passes for another one or for an integer.
#include "algebra3d/kernel/planar/detail/ids.h"

#include <gtest/gtest.h>

#include "algebra3d/kernel/planar/detail/subdivision.h"
#include "support/separate_ids.h"

namespace algebra3d::planar {
namespace {

[[maybe_unused]] constexpr void check_planar_ids() {
  check_pairs<VertexId, HalfedgeId, SegmentId>();
}

TEST(PlanarIds, number_what_a_subdivision_has) {
  Subdivision edges(3);
  const HalfedgeId h = edges.add(VertexId(2), VertexId(0));
  EXPECT_EQ(edges.origin(h), VertexId(2));
  EXPECT_EQ(edges.target(h), VertexId(0));
  EXPECT_EQ(edges.halfedges().size(), 2U);
  EXPECT_TRUE(edges.outer_halfedge().is_none());
  edges.remove(h);
  EXPECT_TRUE(edges.is_taken_out(h));
  EXPECT_EQ(edges.add(VertexId(0), VertexId(1)), h);
}

}  // namespace
}  // namespace algebra3d::planar
