// No identifier of an arrangement passes for another one, for a handle of a mesh, or for an integer.
#include "algebra3d/kernel/arrangement/detail/ids.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "algebra3d/halfedge/handle.h"
#include "algebra3d/kernel/arrangement/detail/front_winding_ids.h"
#include "support/separate_ids.h"

namespace algebra3d::arrangement {
namespace {

/// Checks each pair of ids at compile time.
[[maybe_unused]] constexpr void check_all_pairs() {
  check_pairs<OperandId, InputFaceId, InputHalfedgeId, InputVertexId, InputEdgeId, FacetId, PlaneId, NodeId, SegmentId,
              SubEdgeId, SubEdgeSide, PatchId, FrontWindingId>();
}

template <typename Handle, typename... Ids>
constexpr bool kIsNone = (kAreApart<Handle, Ids> && ...);
static_assert(kIsNone<FaceId, OperandId, InputFaceId, FacetId, PlaneId, PatchId>);
static_assert(kIsNone<HalfedgeId, InputHalfedgeId, InputEdgeId, SegmentId, SubEdgeId, SubEdgeSide>);
static_assert(kIsNone<VertexId, InputVertexId, NodeId>);
static_assert(!AreCompared<Side, int> && !std::is_convertible_v<Side, int>);

TEST(Ids, a_side_of_a_sub_edge_is_both) {
  const SubEdgeSide left(SubEdgeId(7), Side::left), right(SubEdgeId(7), Side::right);
  EXPECT_EQ(left.sub_edge(), SubEdgeId(7));
  EXPECT_EQ(right.sub_edge(), SubEdgeId(7));
  EXPECT_EQ(left.side(), Side::left);
  EXPECT_EQ(right.side(), Side::right);
  EXPECT_LT(left, right);
  EXPECT_LT(right, SubEdgeSide(SubEdgeId(8), Side::left));
  EXPECT_EQ(SubEdgeSide(left.index()), left);
}

TEST(Ids, front_windings_of_patches_follow_those_of_sub_facets) {
  // Two sub-edges: the left sides bound one sub-facet, the right side of the second one another, that of the first
  // none.
  const FrontWindingId one(0), other(1);
  const FrontWindingIds ids({one, FrontWindingId::none(), one, other}, 2, 2);
  EXPECT_EQ(ids.count(), 4U);
  EXPECT_EQ(ids.of(SubEdgeSide(SubEdgeId(1), Side::right)), other);
  EXPECT_TRUE(ids.of(SubEdgeSide(SubEdgeId(0), Side::right)).is_none());
  EXPECT_EQ(ids.of(PatchId(0)), FrontWindingId(2));
}

}  // namespace
}  // namespace algebra3d::arrangement
