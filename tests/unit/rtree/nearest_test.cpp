#include <gtest/gtest.h>

#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::Entries;
using samples::Kind;
using samples::kInfinity;
using samples::kLeast;
using samples::kMax;
using samples::Tree;

struct Expected {
  long double distance;
  std::uint64_t payload;
};

// By a scan in wider arithmetic, which neither overflows nor loses what double arithmetic tells apart.
std::vector<Expected> scan_distances(const Entries& entries, const Box3& box) {
  std::vector<Expected> result;
  for (const auto& entry : entries) {
    long double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long double above = static_cast<long double>(entry.box.min[axis]) - box.max[axis];
      const long double below = static_cast<long double>(box.min[axis]) - entry.box.max[axis];
      const long double gap = std::max({0.0L, above, below});
      sum += gap * gap;
    }
    result.push_back({std::sqrt(sum), entry.payload});
  }
  std::ranges::sort(result, [](const Expected& a, const Expected& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.payload < b.payload;
  });
  return result;
}

void expect_all_neighbours(const Entries& entries, const Tree& tree, const Box3& box) {
  auto cursor = tree.nearest(box);
  std::vector<bool> seen(entries.size(), false);
  for (const Expected& expected : scan_distances(entries, box)) {
    const auto found = cursor.next();
    ASSERT_TRUE(found.has_value());
    ASSERT_FALSE(seen[found->payload]);
    seen[found->payload] = true;
    // Distances that differ in the last place may come in either order.
    ASSERT_NEAR(found->distance, static_cast<double>(expected.distance),
                1e-15 * static_cast<double>(expected.distance) * 4);
  }
  ASSERT_FALSE(cursor.next().has_value());
}

TEST(Nearest, gives_every_entry_by_growing_distance) {
  for (const Kind kind : samples::kKinds) {
    const Entries entries = samples::random_entries(700, kind, 1);
    const Tree bulk = Tree::bulk_load(entries);
    const Tree grown = samples::inserted(entries);
    std::mt19937_64 random(2);
    for (int round = 0; round < 20; ++round) {
      const Box3 box = samples::random_box(random, kind);
      expect_all_neighbours(entries, bulk, box);
      expect_all_neighbours(entries, grown, box);
    }
  }
}

// Whole coordinates: squares are exact, so ties are true ties.
TEST(Nearest, equal_distances_come_by_payload) {
  Entries entries = samples::random_entries(5000, Kind::grid, 3);
  std::mt19937_64 random(4);
  std::ranges::shuffle(entries, random);
  const Tree bulk = Tree::bulk_load(entries);
  const Tree grown = samples::inserted(entries);
  for (int round = 0; round < 20; ++round) {
    const Box3 box = samples::random_box(random, Kind::grid);
    auto from_bulk = bulk.nearest(box);
    auto from_grown = grown.nearest(box);
    for (const Expected& expected : scan_distances(entries, box)) {
      const Neighbor<std::uint64_t> wanted{expected.payload, static_cast<double>(expected.distance)};
      ASSERT_EQ(from_bulk.next(), wanted);
      ASSERT_EQ(from_grown.next(), wanted);
    }
  }
}

TEST(Nearest, a_limit_ends_the_search_and_changes_nothing_before) {
  for (const Kind kind : {Kind::uniform, Kind::grid, Kind::outlier, Kind::identical}) {
    const Tree tree = Tree::bulk_load(samples::random_entries(3000, kind, 5));
    std::mt19937_64 random(6);
    for (const std::size_t limit : {0, 1, 2, 10, 64, 65, 500, 5000}) {
      const Box3 box = samples::random_box(random, kind);
      auto limited = tree.nearest(box, limit);
      auto unlimited = tree.nearest(box);
      for (std::size_t i = 0; i < std::min(limit, tree.size()); ++i) ASSERT_EQ(limited.next(), unlimited.next());
      ASSERT_FALSE(limited.next());
    }
  }
}

// Many leaves at one distance, and more entries than those that are asked for.
TEST(Nearest, ties_in_many_nodes_come_by_payload) {
  Entries entries;
  for (std::uint64_t id = 0; id < 20'000; ++id)
    entries.push_back({{{0, 0, 0}, {1, 1, 1 + static_cast<double>(id % 7)}}, 19'999 - id});
  const Tree tree = Tree::bulk_load(entries);
  for (const Box3& box : {Box3::of({0.5, 0.5, 0.5}), Box3::of({3, 0.5, 0.5})}) {
    for (const std::size_t limit : {1, 10, 60, 64}) {
      auto cursor = tree.nearest(box, limit);
      for (std::uint64_t id = 0; id < limit; ++id) ASSERT_EQ(cursor.next()->payload, id);
      ASSERT_FALSE(cursor.next());
    }
  }
}

// One key has many of the small boxes then.
TEST(Nearest, of_small_boxes_in_a_coarse_frame) {
  for (const double far : {1e9, 1e40, 1e140}) {
    std::mt19937_64 random(8);
    Entries entries;
    for (std::uint64_t id = 0; id < 3000; ++id) {
      const Vec3 corner = samples::random_vec(random, 1, 2);
      entries.push_back({samples::box_at(1e-5 * corner + Vec3{1, 1, 1}, 1e-7 * samples::random_vec(random, 0, 1)), id});
    }
    entries.push_back({Box3::of({far, -far, far}), 3000});
    const Tree tree = Tree::bulk_load(entries);
    for (int round = 0; round < 20; ++round) {
      const Box3 box = entries[random() % entries.size()].box;
      auto limited = tree.nearest(box, 12);
      const std::vector<Expected> wanted = scan_distances(entries, box);
      for (std::size_t i = 0; i < 12; ++i) {
        const auto found = limited.next();
        ASSERT_TRUE(found.has_value());
        ASSERT_NEAR(found->distance, static_cast<double>(wanted[i].distance), 1e-20);
      }
    }
  }
}

// All of them touch the ends of the frame of keys, before and behind which there are no keys.
TEST(Nearest, of_boxes_outside_of_the_frame_of_keys) {
  Entries entries;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0})
      for (int copy = 0; copy < 8; ++copy) {
        Vec3 low{0, 0, 0}, high{1, 1, 1};
        low[axis] = high[axis] = side;
        Box3 box = Box3::of(low);
        box.extend(high);
        entries.push_back({box, entries.size()});
      }
  const Tree tree = Tree::bulk_load(entries);
  for (const double x : {-0.75, -0x1p-1060, 0.25, 1.5})
    for (const double y : {-0.375, 0.5, 1.25})
      for (const double z : {-4.0, 0.125, 7.0}) {
        const Box3 place = Box3::of({x, y, z});
        expect_all_neighbours(entries, tree, place);
        const std::vector<Expected> wanted = scan_distances(entries, place);
        for (const std::size_t limit : {1, 9, 40}) {
          auto cursor = tree.nearest(place, limit);
          for (std::size_t i = 0; i < limit; ++i) {
            const auto found = cursor.next();
            ASSERT_TRUE(found.has_value());
            ASSERT_NEAR(found->distance, static_cast<double>(wanted[i].distance), 1e-14);
          }
        }
      }
}

TEST(Nearest, distances_whose_squares_underflow_or_overflow_keep_their_order) {
  for (const double unit : {1e-200, 1e-310, 1e300}) {
    Tree tree;
    for (std::uint64_t id = 0; id < 40; ++id) {
      const double x = unit * static_cast<double>(40 - id);
      tree.insert(Box3::of({x, 0, 0}), id);
    }
    auto cursor = tree.nearest(Box3::of({0, 0, 0}));
    for (std::uint64_t id = 40; id-- > 0;) ASSERT_EQ(cursor.next()->payload, id);
  }
}

// Beyond the largest double, too, distances were equal once.
TEST(Nearest, distances_that_overflow_keep_their_order) {
  const std::vector<algebra3d::Vec3> points = {
      {-kMax, -kMax, -kMax},  {-kMax, -kMax, 0},         {0, -kMax, 0},     {1e308, 0, 0}, {kMax, kMax, 1e308},
      {kMax, kMax, kMax / 2}, {kMax, kMax, 0.75 * kMax}, {kMax, kMax, kMax}};
  Tree tree;
  for (std::uint64_t id = 0; id < points.size(); ++id) tree.insert(Box3::of(points[id]), id);
  for (const std::size_t limit : {points.size(), std::size_t{1000}}) {
    auto cursor = tree.nearest(Box3::of({kMax, kMax, kMax}), limit);
    for (const std::uint64_t id : {7, 6, 4, 5, 3, 2, 1, 0}) ASSERT_EQ(cursor.next()->payload, id);
  }
  for (std::uint64_t id = 0; id < 5; ++id) tree.insert(Box3::of({static_cast<double>(5 - id) * kLeast, 0, 0}), 10 + id);
  tree.insert(Box3::of({0.75, 0, 0}), 20);
  tree.insert(Box3::of({1, 0, 0}), 21);
  tree.insert(Box3::of({0, 1.5, 0}), 22);
  auto cursor = tree.nearest(Box3::of({0, 0, 0}), 8);
  for (std::uint64_t id = 5; id-- > 0;)
    ASSERT_EQ(cursor.next(), (Neighbor<std::uint64_t>{10 + id, static_cast<double>(5 - id) * kLeast}));
  ASSERT_EQ(cursor.next(), (Neighbor<std::uint64_t>{20, 0.75}));
  ASSERT_EQ(cursor.next(), (Neighbor<std::uint64_t>{21, 1}));
  ASSERT_EQ(cursor.next(), (Neighbor<std::uint64_t>{22, 1.5}));
}

TEST(Nearest, infinite_boxes_have_distances_too) {
  Tree tree;
  tree.insert({{-kInfinity, 5, 5}, {kInfinity, 6, 6}}, 1);
  tree.insert({{0, 0, 2}, {1, 1, 3}}, 2);
  auto from_point = tree.nearest(Box3::of({0, 0, 0}));
  EXPECT_EQ(from_point.next(), (Neighbor<std::uint64_t>{2, 2}));
  EXPECT_EQ(from_point.next()->payload, 1);
  EXPECT_FALSE(from_point.next());
  auto from_slab = tree.nearest({{-kInfinity, -kInfinity, 4}, {kInfinity, kInfinity, 4.5}});
  EXPECT_EQ(from_slab.next(), (Neighbor<std::uint64_t>{1, 0.5}));
  EXPECT_EQ(from_slab.next(), (Neighbor<std::uint64_t>{2, 1}));
}

TEST(Nearest, empty_trees_and_empty_boxes_have_no_neighbours) {
  Tree tree;
  EXPECT_FALSE(tree.nearest(Box3::of({0, 0, 0})).next());
  tree.insert(Box3::of({1, 1, 1}), 1);
  EXPECT_FALSE(tree.nearest(Box3{}).next());
}

}  // namespace
}  // namespace rtree
