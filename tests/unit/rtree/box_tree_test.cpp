#include <gtest/gtest.h>

#include "base/scheduler.h"
#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::Kind;
using NarrowPairs = std::vector<Pair<std::uint32_t>>;

std::vector<Box3> random_boxes(std::size_t count, Kind kind, unsigned seed) {
  std::vector<Box3> boxes;
  for (const auto& entry : samples::random_entries(count, kind, seed)) boxes.push_back(entry.box);
  return boxes;
}

TEST(BoxTree, gives_what_a_tree_of_entries_gives) {
  for (const Kind kind : samples::kKinds) {
    const auto entries = samples::random_entries(2000, kind, 1);
    const std::vector<Box3> boxes = random_boxes(2000, kind, 1);
    const samples::Tree tree = samples::Tree::bulk_load(entries);
    const BoxTree box_tree(boxes);
    ASSERT_EQ(box_tree.size(), boxes.size());
    ASSERT_EQ(audit(box_tree.storage()), std::vector<std::string>{});
    std::mt19937_64 random(2);
    for (int round = 0; round < 20; ++round) {
      const Box3 box = samples::random_box(random, kind);
      std::vector<std::uint64_t> ids;
      for (const std::uint32_t id : box_tree.window(box)) ids.push_back(id);
      std::ranges::sort(ids);
      ASSERT_EQ(ids, samples::scan(entries, box));
      for (const std::size_t limit : {1, 10, 64, 100}) {
        auto expected = tree.nearest(box, limit);
        auto found = box_tree.nearest(box, limit);
        for (std::size_t i = 0; i < limit; ++i) {
          const auto a = expected.next();
          const auto b = found.next();
          ASSERT_TRUE(a && b);
          ASSERT_EQ(a->payload, b->payload);
          ASSERT_EQ(a->distance, b->distance);
        }
        ASSERT_FALSE(found.next());
      }
    }
  }
}

TEST(BoxTree, empty_boxes_are_left_out) {
  std::vector<Box3> boxes = random_boxes(1000, Kind::uniform, 3);
  for (std::size_t i = 0; i < boxes.size(); i += 3) boxes[i] = {};
  const BoxTree tree(boxes);
  EXPECT_EQ(tree.size(), 666U);
  for (const std::uint32_t id : tree.window(tree.bounds())) EXPECT_NE(id % 3, 0U);
  EXPECT_TRUE(BoxTree(std::span<const Box3>()).empty());
  EXPECT_FALSE(BoxTree().window({{0, 0, 0}, {1, 1, 1}}).next());
}

TEST(BoxTree, takes_thirty_bytes_an_entry) {
  const std::vector<Box3> boxes = random_boxes(100'000, Kind::uniform, 4);
  EXPECT_LE(BoxTree(boxes).heap_bytes(), 30 * boxes.size());
}

NarrowPairs all_pairs(BoxTree::JoinCursor cursor) {
  NarrowPairs pairs;
  while (const auto pair = cursor.next()) pairs.push_back(*pair);
  return pairs;
}

// Enough for all parallel parts, crowded cells of the curve among them. Not sorted: the order is the same as well.
TEST(BoxTree, does_not_depend_on_the_number_of_threads) {
  for (const Kind kind : {Kind::uniform, Kind::clustered, Kind::outlier}) {
    std::vector<Box3> boxes = random_boxes(150'000, kind, 5);
    if (kind == Kind::uniform)
      for (Box3& box : boxes) box.max = box.min + 0.1 * (box.max - box.min);
    if (kind == Kind::clustered)
      for (Box3& box : boxes) box.max = box.min;
    std::vector<NarrowPairs> pairs;
    std::vector<std::vector<std::uint32_t>> orders;
    for (const int threads : {1, 2, 4}) {
      algebra3d::with_threads(threads, [&] {
        const BoxTree tree(boxes);
        ASSERT_EQ(audit(tree.storage()), std::vector<std::string>{});
        orders.emplace_back();
        for (const std::uint32_t id : tree.window(tree.bounds())) orders.back().push_back(id);
        if (kind != Kind::outlier) pairs.push_back(all_pairs(tree.self_join()));
      });
    }
    for (const auto& order : orders) EXPECT_EQ(order, orders[0]);
    for (const auto& some : pairs) EXPECT_EQ(some, pairs[0]);
  }
}

}  // namespace
}  // namespace rtree
