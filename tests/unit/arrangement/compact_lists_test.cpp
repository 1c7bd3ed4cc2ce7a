// The lists that keep an arrangement small: CompactWindings, NumbersByBucket, and what IncidentFacet and RegionKey
// pack.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/compact_windings.h"
#include "algebra3d/kernel/arrangement/detail/numbers_by_bucket.h"
#include "algebra3d/kernel/arrangement/detail/region_edges.h"
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"

namespace algebra3d::arrangement_tests {
namespace {

using namespace arrangement;

TEST(CompactWindings, keep_what_they_are_given) {
  // All that a byte holds, and what needs more, after which nothing may be lost.
  const std::vector<WindingVector> given = {{0, 0},   {127, -128}, {-128, 127}, {1, -1},
                                            {128, 0}, {0, -129},   {5, 6},      {2147483647, -2147483647 - 1}};
  CompactWindings<NodeId> windings(given.size());
  EXPECT_EQ(windings.size(), given.size());
  for (const NodeId id : windings.ids()) EXPECT_EQ(windings[id], WindingVector());
  for (std::size_t count = 1; count <= given.size(); ++count) {
    windings.set(NodeId(count - 1), given[count - 1]);
    for (const NodeId id : windings.ids())
      EXPECT_EQ(windings[id], id.index() < count ? given[id.index()] : WindingVector()) << count;
    EXPECT_EQ(windings.size(), given.size());
  }
}

TEST(NumbersByBucket, are_those_of_each_bucket_ascending) {
  const std::vector<std::size_t> buckets = {3, 0, 3, 3, 1, 0};
  const NumbersByBucket numbers(buckets.size(), 5, [&](std::size_t number) { return buckets[number]; });
  const auto in = [&](std::size_t first, std::size_t last) {
    const auto found = numbers.of(first, last);
    return std::vector<std::uint32_t>(found.begin(), found.end());
  };
  using Numbers = std::vector<std::uint32_t>;
  EXPECT_EQ(numbers.bucket_count(), 5U);
  EXPECT_EQ(in(0, 1), (Numbers{1, 5}));
  EXPECT_EQ(in(1, 2), (Numbers{4}));
  EXPECT_EQ(in(2, 3), Numbers());
  EXPECT_EQ(in(3, 4), (Numbers{0, 2, 3}));
  EXPECT_EQ(in(4, 5), Numbers());
  EXPECT_EQ(in(0, 5), (Numbers{1, 5, 4, 0, 2, 3}));
  EXPECT_TRUE(NumbersByBucket(0, 2, [](std::size_t) { return 0; }).of(1).empty());
}

TEST(PackedIds, give_their_parts) {
  for (const std::uint32_t number : {0U, 1U, (1U << 30U) - 1}) {
    for (const FacetSides sides : {FacetSides::both, FacetSides::left, FacetSides::right}) {
      EXPECT_EQ(IncidentFacet(FacetId(number), sides).facet(), FacetId(number));
      EXPECT_EQ(IncidentFacet(FacetId(number), sides).sides(), sides);
    }
    for (const bool is_flipped : {false, true}) {
      EXPECT_EQ(RegionKey(PlaneId(number), is_flipped).plane(), PlaneId(number));
      EXPECT_EQ(RegionKey(PlaneId(number), is_flipped).is_flipped(), is_flipped);
    }
  }
  // By planes, and those that are not flipped first.
  EXPECT_LT(RegionKey(PlaneId(1), true), RegionKey(PlaneId(2), false));
  EXPECT_LT(RegionKey(PlaneId(1), false), RegionKey(PlaneId(1), true));
}

}  // namespace
}  // namespace algebra3d::arrangement_tests
