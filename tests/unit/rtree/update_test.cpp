#include <gtest/gtest.h>

#include "support/rounds.h"
#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::Entries;
using samples::Kind;
using samples::Tree;

const std::vector<std::string> kNothing{};

TEST(BulkLoad, every_small_count_gives_a_sound_tree) {
  const std::size_t powers[] = {255, 256, 257, 273, 4095, 4096, 4097, 4352, 65'536, 65'537};
  std::vector<std::size_t> counts(powers, std::end(powers));
  for (std::size_t count = 0; count <= 3 * kFanOut * kFanOut; ++count) counts.push_back(count);
  for (const std::size_t count : counts) {
    const Entries entries = samples::random_entries(count, Kind::uniform, 1);
    const Tree tree = Tree::bulk_load(entries);
    ASSERT_EQ(audit(tree), kNothing) << count;
    ASSERT_EQ(tree.size(), count);
    Box3 bounds;
    for (const auto& entry : entries) bounds.extend(entry.box);
    ASSERT_EQ(tree.bounds(), bounds);
    const Box3 everything{{-1, -1, -1}, {200, 200, 200}};
    ASSERT_EQ(samples::window_ids(tree, everything), samples::scan(entries, everything)) << count;
  }
}

TEST(BulkLoad, does_not_depend_on_the_order_of_the_entries) {
  for (const Kind kind : samples::kKinds) {
    Entries entries = samples::random_entries(5000, kind, 2);
    const auto order = [](const Tree& tree) {
      std::vector<std::uint64_t> ids;
      for (const std::uint64_t id : tree.window(tree.bounds())) ids.push_back(id);
      return ids;
    };
    const auto expected = order(Tree::bulk_load(entries));
    std::mt19937_64 random(3);
    std::ranges::shuffle(entries, random);
    ASSERT_EQ(order(Tree::bulk_load(entries)), expected);
  }
}

TEST(BulkLoad, leaves_are_full_and_memory_is_as_announced) {
  const Entries entries = samples::random_entries(100'000, Kind::uniform, 4);
  const Tree wide = Tree::bulk_load(entries);
  EXPECT_LE(wide.heap_bytes(), 62 * entries.size());
  std::vector<Entry<std::uint32_t>> narrow;
  for (const auto& entry : entries) narrow.push_back({entry.box, static_cast<std::uint32_t>(entry.payload)});
  EXPECT_LE(RTree<std::uint32_t>::bulk_load(narrow).heap_bytes(), 58 * entries.size());
}

TEST(EmptyBoxes, are_never_stored) {
  Tree tree;
  EXPECT_FALSE(tree.insert(Box3{}, 1));
  EXPECT_FALSE(tree.insert({{0, 0, 0}, {1, -1, 1}}, 1));
  EXPECT_FALSE(tree.insert({{0, std::nan(""), 0}, {1, 1, 1}}, 1));
  EXPECT_FALSE(tree.erase(Box3{}, 1));
  EXPECT_TRUE(tree.empty());
  Entries entries = samples::random_entries(100, Kind::uniform, 5);
  for (std::size_t i = 0; i < entries.size(); i += 2) entries[i].box = {};
  EXPECT_EQ(Tree::bulk_load(entries).size(), 50U);
  for (auto& entry : entries) entry.box = {};
  const Tree none = Tree::bulk_load(entries);
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(none.bounds().is_empty());
  EXPECT_EQ(audit(none), kNothing);
}

TEST(Erase, needs_the_very_box_and_payload) {
  Tree tree;
  const Box3 box{{0, 0, 0}, {1, 1, 1}};
  tree.insert(box, 1);
  EXPECT_FALSE(tree.erase(box, 2));
  EXPECT_FALSE(tree.erase({{0, 0, 0}, {1, 1, 0.5}}, 1));
  EXPECT_TRUE(tree.erase(box, 1));
  EXPECT_FALSE(tree.erase(box, 1));
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(audit(tree), kNothing);
}

TEST(Erase, takes_equal_entries_one_by_one) {
  Entries entries = samples::random_entries(10'000, Kind::identical, 6);
  Tree tree = Tree::bulk_load(entries);
  std::mt19937_64 random(7);
  std::ranges::shuffle(entries, random);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ASSERT_TRUE(tree.erase(entries[i].box, entries[i].payload));
    if (i % 1000 != 0) continue;
    ASSERT_EQ(audit(tree), kNothing);
  }
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(audit(tree), kNothing);
}

// The tree grows for some operations, shrinks for as many and grows again, and stays what a plain list says it is.
void check_mixed_operations(Kind kind, std::size_t operation_count, Tree tree, Entries alive,
                            std::size_t operations_of_a_phase = 10'000) {
  std::mt19937_64 random(8);
  std::uint64_t next_id = alive.size();
  for (std::size_t step = 1; step <= operation_count; ++step) {
    const std::uint64_t inserts_of_ten = (step / operations_of_a_phase) % 2 == 0 ? 7 : 3;
    if (alive.empty() || random() % 10 < inserts_of_ten) {
      alive.push_back({samples::random_box(random, kind), next_id++});
      ASSERT_TRUE(tree.insert(alive.back().box, alive.back().payload));
    } else {
      std::swap(alive[random() % alive.size()], alive.back());
      ASSERT_TRUE(tree.erase(alive.back().box, alive.back().payload));
      ASSERT_FALSE(tree.erase(alive.back().box, alive.back().payload));
      alive.pop_back();
    }
    if (step % 1000 != 0) continue;
    ASSERT_EQ(audit(tree), kNothing);
    ASSERT_EQ(tree.size(), alive.size());
    for (int round = 0; round < 5; ++round) {
      const Box3 window = samples::random_box(random, kind);
      ASSERT_EQ(samples::window_ids(tree, window), samples::scan(alive, window));
    }
  }
  for (const auto& entry : alive) ASSERT_TRUE(tree.erase(entry.box, entry.payload));
  ASSERT_TRUE(tree.empty());
  ASSERT_EQ(audit(tree), kNothing);
}

TEST(Updates, a_hundred_thousand_operations_keep_the_invariants) {
  check_mixed_operations(Kind::uniform, 100'000, {}, {});
}

TEST(Updates, hold_for_every_kind_of_box) {
  for (const Kind kind : samples::kKinds) {
    if (kind != Kind::identical)
      check_mixed_operations(kind, algebra3d::is_thorough() ? 20'000 : 6000, {}, {},
                             algebra3d::is_thorough() ? 10'000 : 3000);
  }
}

TEST(Updates, a_bulk_loaded_tree_can_be_changed) {
  const Entries entries = samples::random_entries(20'000, Kind::clustered, 9);
  check_mixed_operations(Kind::clustered, 30'000, Tree::bulk_load(entries), entries);
}

TEST(Updates, the_same_history_gives_the_same_order) {
  const Entries entries = samples::random_entries(5000, Kind::grid, 10);
  std::vector<std::uint64_t> orders[2];
  for (auto& order : orders) {
    Tree tree = samples::inserted(entries);
    for (std::size_t i = 0; i < entries.size(); i += 3) tree.erase(entries[i].box, entries[i].payload);
    for (const std::uint64_t id : tree.window(tree.bounds())) order.push_back(id);
  }
  EXPECT_EQ(orders[0], orders[1]);
}

}  // namespace
}  // namespace rtree
