#include <gtest/gtest.h>

#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::Entries;
using samples::Kind;
using samples::Pairs;
using samples::scan_pairs;
using samples::Tree;

Pairs scan_own_pairs(const Entries& entries) {
  Pairs pairs = scan_pairs(entries, entries);
  std::erase_if(pairs, [](const auto& pair) { return pair.first >= pair.second; });
  return pairs;
}

TEST(Join, both_ways_finds_what_a_scan_finds) {
  for (const Kind kind : samples::kKinds) {
    // Trees of different height, so that all branches are walked.
    for (const auto& [first_count, second_count] : {std::pair{700, 500}, {900, 20}, {3, 900}}) {
      const Entries first = samples::random_entries(first_count, kind, 1);
      const Entries second = samples::random_entries(second_count, kind, 2);
      const Pairs expected = scan_pairs(first, second);
      ASSERT_EQ(samples::sorted_pairs(Tree::bulk_load(first).join(Tree())), Pairs{});
      const Tree a = Tree::bulk_load(first);
      const Tree b = samples::inserted(second);
      ASSERT_EQ(samples::sorted_pairs(a.join(b)), expected);
      ASSERT_EQ(samples::sorted_pairs(b.join(a)), scan_pairs(second, first));
    }
  }
}

TEST(Join, a_tree_with_itself_gives_ordered_pairs_and_the_entries_themselves) {
  const Entries entries = samples::random_entries(600, Kind::uniform, 3);
  const Tree tree = Tree::bulk_load(entries);
  EXPECT_EQ(samples::sorted_pairs(tree.join(tree)), scan_pairs(entries, entries));
}

TEST(SelfJoin, gives_each_pair_once_with_the_smaller_payload_first) {
  for (const Kind kind : samples::kKinds) {
    Entries entries = samples::random_entries(800, kind, 4);
    std::mt19937_64 random(5);
    std::ranges::shuffle(entries, random);
    const Pairs expected = scan_own_pairs(entries);
    for (const Tree& tree : {Tree::bulk_load(entries), samples::inserted(entries)}) {
      ASSERT_EQ(samples::sorted_pairs(tree.self_join()), expected);
      Pairs visited;
      for_each_pair(tree, [&](std::uint64_t a, std::uint64_t b) { visited.push_back({a, b}); });
      std::ranges::sort(visited);
      ASSERT_EQ(visited, expected);
    }
  }
}

TEST(SelfJoin, equal_entries_are_a_pair) {
  const Box3 box{{0, 0, 0}, {1, 1, 1}};
  Tree tree;
  tree.insert(box, 4);
  EXPECT_EQ(samples::sorted_pairs(tree.self_join()), Pairs{});
  tree.insert(box, 4);
  EXPECT_EQ(samples::sorted_pairs(tree.self_join()), (Pairs{{4, 4}}));
}

TEST(SelfJoin, empty_trees_have_no_pairs) {
  EXPECT_EQ(samples::sorted_pairs(Tree().self_join()), Pairs{});
  EXPECT_EQ(samples::sorted_pairs(Tree().join(Tree())), Pairs{});
}

TEST(Join, next_and_next_batch_share_one_position) {
  const Entries entries = samples::random_entries(300, Kind::identical, 6);
  const Tree tree = Tree::bulk_load(entries);
  auto cursor = tree.self_join();
  std::size_t count = 0;
  while (cursor.next()) {
    ++count;
    count += cursor.next_batch().size();
  }
  EXPECT_EQ(count, 300U * 299 / 2);
}

}  // namespace
}  // namespace rtree
