#include "rtree/detail/node_set.h"

#include <gtest/gtest.h>

namespace rtree {
namespace {

TEST(NodeSet, tells_what_is_missing_across_words) {
  NodeSet set(200);
  for (NodeIndex node = 0; node < 200; ++node) {
    if (node == 0 || node == 63 || node == 64 || node == 130 || node == 199) continue;
    EXPECT_TRUE(set.insert(node));
  }
  EXPECT_EQ(set.missing(200), (std::vector<NodeIndex>{0, 63, 64, 130, 199}));
  EXPECT_EQ(set.missing(128), (std::vector<NodeIndex>{0, 63, 64}));
  EXPECT_EQ(set.missing(202), (std::vector<NodeIndex>{0, 63, 64, 130, 199, 200, 201}));
  EXPECT_FALSE(set.insert(1));
}

TEST(NodeSet, misses_all_nodes_at_first) {
  EXPECT_EQ(NodeSet().missing(3), (std::vector<NodeIndex>{0, 1, 2}));
  EXPECT_TRUE(NodeSet().missing(0).empty());
}

// A node is sound if its used slots come first, with boxes, and the others are as `clear` leaves them.
TEST(KeyBoxes, are_sound_if_used_slots_come_first) {
  KeyBoxes boxes;
  boxes.clear();
  EXPECT_TRUE(boxes.is_sound(0));
  EXPECT_FALSE(boxes.is_sound(1));
  for (std::size_t slot = 0; slot < 6; ++slot) boxes.set_box(slot, {{0, 0, 0}, {1, 0, 7}});
  EXPECT_TRUE(boxes.is_sound(6));
  EXPECT_FALSE(boxes.is_sound(7));
  const auto is_damaged = [&](auto&& damage) {
    KeyBoxes copy = boxes;
    damage(copy);
    return !copy.is_sound(2);
  };
  EXPECT_TRUE(is_damaged([](KeyBoxes& copy) { copy.clear(3); }));
  EXPECT_TRUE(is_damaged([](KeyBoxes& copy) { copy.min[1][2] = 5; }));
  EXPECT_TRUE(is_damaged([](KeyBoxes& copy) { copy.max[2][5] = INT32_MAX; }));
  EXPECT_TRUE(is_damaged([](KeyBoxes& copy) { copy.min[2][6] = 0; }));
  EXPECT_TRUE(is_damaged([](KeyBoxes& copy) { copy.max[0][15] = 0; }));
  EXPECT_TRUE(is_damaged([](KeyBoxes& copy) { copy.set_box(9, {{0, 0, 0}, {1, 1, 1}}); }));
  EXPECT_FALSE(is_damaged([](KeyBoxes& copy) { copy.set_box(6, {{0, 0, 0}, {1, 1, 1}}); }));
}

}  // namespace
}  // namespace rtree
