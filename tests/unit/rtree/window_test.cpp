#include <gtest/gtest.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::Entries;
using samples::Kind;
using samples::kInfinity;
using samples::Tree;

TEST(Window, bulk_loaded_and_inserted_trees_find_what_a_scan_finds) {
  for (const Kind kind : samples::kKinds) {
    const Entries entries = samples::random_entries(3000, kind, 1);
    const Tree bulk = Tree::bulk_load(entries);
    const Tree grown = samples::inserted(entries);
    ASSERT_EQ(audit(bulk), std::vector<std::string>{});
    ASSERT_EQ(audit(grown), std::vector<std::string>{});
    std::mt19937_64 random(2);
    for (int round = 0; round < 200; ++round) {
      const Box3 window = samples::random_box(random, kind);
      const auto expected = samples::scan(entries, window);
      ASSERT_EQ(samples::window_ids(bulk, window), expected);
      ASSERT_EQ(samples::window_ids(grown, window), expected);
    }
  }
}

TEST(Window, agrees_with_boost) {
  namespace bg = boost::geometry;
  using Point = bg::model::point<double, 3, bg::cs::cartesian>;
  using Box = bg::model::box<Point>;
  using Value = std::pair<Box, std::uint64_t>;
  const auto boost_box = [](const Box3& b) { return Box({b.min.x, b.min.y, b.min.z}, {b.max.x, b.max.y, b.max.z}); };

  const Entries entries = samples::random_entries(20'000, Kind::uniform, 3);
  std::vector<Value> values;
  for (const auto& entry : entries) values.emplace_back(boost_box(entry.box), entry.payload);
  const bg::index::rtree<Value, bg::index::rstar<16>> oracle(values);
  const Tree tree = Tree::bulk_load(entries);
  std::mt19937_64 random(4);
  for (int round = 0; round < 1000; ++round) {
    const Box3 window = samples::random_box(random, Kind::uniform);
    std::vector<std::uint64_t> expected;
    for (auto it = oracle.qbegin(bg::index::intersects(boost_box(window))); it != oracle.qend(); ++it)
      expected.push_back(it->second);
    std::ranges::sort(expected);
    ASSERT_EQ(samples::window_ids(tree, window), expected);
  }
}

TEST(Window, infinite_windows_are_rays_half_spaces_and_everything) {
  const Entries entries = samples::random_entries(1000, Kind::uniform, 5);
  const Tree tree = Tree::bulk_load(entries);
  const Box3 windows[] = {
      {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}},
      {{50, 50, -kInfinity}, {50, 50, kInfinity}},
      {{50, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}},
      {{kInfinity, kInfinity, kInfinity}, {kInfinity, kInfinity, kInfinity}},
  };
  for (const Box3& window : windows) EXPECT_EQ(samples::window_ids(tree, window), samples::scan(entries, window));
  EXPECT_EQ(samples::window_ids(tree, windows[0]).size(), entries.size());
}

TEST(Window, touching_counts_and_empty_windows_meet_nothing) {
  Tree tree;
  tree.insert({{0, 0, 0}, {1, 1, 1}}, 7);
  EXPECT_EQ(samples::window_ids(tree, {{1, 1, 1}, {2, 2, 2}}), std::vector<std::uint64_t>{7});
  EXPECT_TRUE(samples::window_ids(tree, {{std::nextafter(1, 2), 0, 0}, {2, 2, 2}}).empty());
  EXPECT_TRUE(samples::window_ids(tree, Box3{}).empty());
  EXPECT_TRUE(samples::window_ids(tree, {{0.9, 0, 0}, {0.1, 1, 1}}).empty());
  EXPECT_TRUE(samples::window_ids(tree, {{std::nan(""), 0, 0}, {1, 1, 1}}).empty());
}

TEST(Window, infinite_entries_are_found) {
  Entries entries = samples::random_entries(500, Kind::uniform, 6);
  entries.push_back({{{-kInfinity, 0, 0}, {kInfinity, 1, 1}}, 500});
  entries.push_back({{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}, 501});
  entries.push_back({{{3, kInfinity, 3}, {3, kInfinity, 3}}, 502});
  const Tree bulk = Tree::bulk_load(entries);
  const Tree grown = samples::inserted(entries);
  EXPECT_EQ(audit(bulk), std::vector<std::string>{});
  EXPECT_EQ(audit(grown), std::vector<std::string>{});
  std::mt19937_64 random(7);
  for (int round = 0; round < 100; ++round) {
    const Box3 window = samples::random_box(random, Kind::uniform);
    EXPECT_EQ(samples::window_ids(bulk, window), samples::scan(entries, window));
    EXPECT_EQ(samples::window_ids(grown, window), samples::scan(entries, window));
  }
}

TEST(Window, small_payloads_work_alike) {
  std::vector<Entry<std::uint32_t>> entries;
  for (const auto& entry : samples::random_entries(2000, Kind::clustered, 8))
    entries.push_back({entry.box, static_cast<std::uint32_t>(entry.payload)});
  const auto tree = RTree<std::uint32_t>::bulk_load(entries);
  EXPECT_EQ(audit(tree), std::vector<std::string>{});
  for (const auto& [box, id] : entries) {
    std::vector<std::uint32_t> expected, found;
    for (const auto& entry : entries)
      if (entry.box.intersects(box)) expected.push_back(entry.payload);
    for (const std::uint32_t hit : tree.window(box)) found.push_back(hit);
    std::ranges::sort(found);
    ASSERT_EQ(found, expected) << id;
  }
}

// Collecting all of 10^10 results before the first would take minutes.
TEST(Window, results_come_lazily) {
  const Tree tree = Tree::bulk_load(samples::random_entries(100'000, Kind::identical, 9));
  for (int round = 0; round < 100'000; ++round) ASSERT_TRUE(tree.window({{1, 2, 3}, {4, 5, 6}}).next().has_value());
}

}  // namespace
}  // namespace rtree
