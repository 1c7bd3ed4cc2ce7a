#include "algebra3d/kernel/rounding/detail/edge_chains.h"

#include <cmath>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

std::vector<PointId> points_of(std::span<const PointId> chain) {
  return {chain.begin(), chain.end()};
}

TEST(EdgeChains, are_routed_through_points_in_the_order_along_the_edge) {
  const IdVector<PointId, Vec3> points{{0, 0, 0}, {10, 0, 0}, {7, 1, 0}, {3, 2, 0}, {-1, 0, 0}};
  const PointId start(0), end(1), near_end(2), near_start(3), before(4);
  EdgeChains chains(points);
  const ChainId chain = chains.add(start, end);
  EXPECT_EQ(chains.distance({chain, 0}, near_end), 1);
  EXPECT_TRUE(std::isinf(chains.distance({chain, 0}, before)));
  EXPECT_TRUE(std::isinf(chains.distance({chain, 0}, start)));
  chains.route_through({chain, 0}, near_end);
  chains.route_through({chain, 0}, near_start);
  chains.route_through({chain, 0}, near_end);
  EXPECT_EQ(chains.apply(), std::vector<ChainId>{chain});
  EXPECT_EQ(points_of(chains[chain]), (std::vector<PointId>{start, near_start, near_end, end}));
  EXPECT_EQ(chains.largest_detour(), 2);
  EXPECT_TRUE(chains.apply().empty());
}

TEST(EdgeChains, links_are_refined_in_turn) {
  const IdVector<PointId, Vec3> points{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2.25, 0.9, 0}};
  EdgeChains chains(points);
  const ChainId chain = chains.add(PointId(0), PointId(1));
  chains.route_through({chain, 0}, PointId(2));
  EXPECT_EQ(chains.apply().size(), 1U);
  EXPECT_EQ(chains.link_count(chain), 2U);
  EXPECT_EQ(chains.detour(chain), 1);
  chains.route_through({chain, 1}, PointId(3));
  EXPECT_EQ(chains.apply().size(), 1U);
  EXPECT_EQ(points_of(chains[chain]), (std::vector<PointId>{PointId(0), PointId(2), PointId(3), PointId(1)}));
}

}  // namespace
}  // namespace algebra3d
