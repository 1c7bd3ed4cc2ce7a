#include <gtest/gtest.h>

#include "support/rounds.h"
#include "unit/rtree/rtree_samples.h"

// Boxes that differ by less than keys of 32 bits can tell: compared with a scan over the doubles.
namespace rtree {
namespace {

using samples::Entries;
using samples::kInfinity;
using samples::kLeast;
using samples::kMax;
using samples::Pairs;
using samples::scan_pairs;
using samples::Tree;

// Coordinates around `place`, `ulps` representable steps from it at most.
struct Around {
  double place;
  int ulps;

  double operator()(std::mt19937_64& random) const {
    double x = place;
    const int steps = static_cast<int>(random() % (2 * ulps + 1)) - ulps;
    for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, steps > 0 ? kInfinity : -kInfinity);
    return x;
  }
};

template <typename Coordinate>
Entries entries_of(const Coordinate& coordinate, std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  Entries entries;
  for (std::size_t id = 0; id < count; ++id) {
    Box3 box;
    for (int corner = 0; corner < 2; ++corner) {
      const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
      box.extend(Vec3{x, y, z});
    }
    entries.push_back({box, id});
  }
  return entries;
}

std::vector<Box3> boxes_of(const Entries& entries) {
  std::vector<Box3> boxes;
  for (const auto& entry : entries) boxes.push_back(entry.box);
  return boxes;
}

std::vector<std::uint64_t> ids_of(BoxTree::WindowCursor cursor) {
  std::vector<std::uint64_t> ids;
  for (const std::uint32_t id : cursor) ids.push_back(id);
  std::ranges::sort(ids);
  return ids;
}

Pairs pairs_of(BoxTree::JoinCursor cursor) {
  Pairs pairs;
  while (const auto pair = cursor.next()) pairs.push_back({pair->first, pair->second});
  std::ranges::sort(pairs);
  return pairs;
}

template <typename Coordinate>
void expect_exact(const Coordinate& coordinate, std::size_t count = algebra3d::is_thorough() ? 300 : 150) {
  const Entries first = entries_of(coordinate, count, 1), second = entries_of(coordinate, count, 2);
  const std::vector<Box3> first_boxes = boxes_of(first), second_boxes = boxes_of(second);
  const Tree bulk = Tree::bulk_load(first), grown = samples::inserted(first);
  const BoxTree boxes(first_boxes), other_boxes(second_boxes);
  ASSERT_EQ(audit(bulk), std::vector<std::string>{});
  ASSERT_EQ(audit(grown), std::vector<std::string>{});
  for (const auto& entry : second) {
    const auto expected = samples::scan(first, entry.box);
    ASSERT_EQ(samples::window_ids(bulk, entry.box), expected);
    ASSERT_EQ(samples::window_ids(grown, entry.box), expected);
    ASSERT_EQ(ids_of(boxes.window(entry.box)), expected);
  }
  const Pairs expected = scan_pairs(first, second);
  ASSERT_EQ(samples::sorted_pairs(bulk.join(Tree::bulk_load(second))), expected);
  ASSERT_EQ(samples::sorted_pairs(grown.join(Tree::bulk_load(second))), expected);
  ASSERT_EQ(pairs_of(boxes.join(other_boxes)), expected);
  Pairs within = scan_pairs(first, first);
  std::erase_if(within, [](const auto& pair) { return pair.first >= pair.second; });
  ASSERT_EQ(samples::sorted_pairs(grown.self_join()), within);
  ASSERT_EQ(pairs_of(boxes.self_join()), within);
  Box3 bounds;
  for (const auto& entry : first) bounds.extend(entry.box);
  ASSERT_EQ(bulk.bounds(), bounds);
  ASSERT_EQ(grown.bounds(), bounds);
  ASSERT_EQ(boxes.bounds(), bounds);
}

TEST(Exactness, boxes_that_differ_by_single_ulps) {
  for (const double place : {1.0, -1.0, 0.1, 1e9, 1e300, -1e300, 1e-300, kLeast, 0.0, kMax}) {
    expect_exact(Around{place, 1});
    expect_exact(Around{place, 3});
    expect_exact(Around{place, 40});
  }
}

// Everything between is in few keys.
TEST(Exactness, ulps_among_coordinates_of_all_sizes) {
  expect_exact([](std::mt19937_64& random) {
    constexpr double kPlaces[] = {-kInfinity, -kMax,  -1e300, -1, -1e-300, -kLeast, 0,
                                  kLeast,     1e-300, 1,      2,  1e9,     1e300,   kInfinity};
    return Around{kPlaces[random() % std::size(kPlaces)], 2}(random);
  });
}

TEST(Exactness, whole_numbers_touch_often) {
  expect_exact([](std::mt19937_64& random) { return static_cast<double>(random() % 4); });
  expect_exact([](std::mt19937_64& random) { return 1e15 + static_cast<double>(random() % 4); });
}

TEST(Exactness, signs_of_zero_do_not_matter) {
  expect_exact([](std::mt19937_64& random) { return random() % 2 == 0 ? 0.0 : -0.0; });
  Tree tree;
  tree.insert({{-0.0, 0, 0}, {1, 1, 1}}, 1);
  EXPECT_TRUE(tree.erase({{0, 0, -0.0}, {1, 1, 1}}, 1));
}

// Trees with keys of different frames: one has coordinates that the other one's keys do not tell apart.
TEST(Exactness, joins_of_trees_that_lie_differently) {
  const Around near_one{1, 20};
  const auto anywhere = [&](std::mt19937_64& random) {
    return random() % 2 == 0 ? near_one(random) : samples::random_vec(random, -1e6, 1e6).x;
  };
  for (const std::size_t count : {40, 400}) {
    const Entries first = entries_of(near_one, 200, 1), second = entries_of(anywhere, count, 2);
    const std::vector<Box3> first_boxes = boxes_of(first), second_boxes = boxes_of(second);
    const Tree a = Tree::bulk_load(first), b = Tree::bulk_load(second);
    const BoxTree c(first_boxes), d(second_boxes);
    ASSERT_EQ(samples::sorted_pairs(a.join(b)), scan_pairs(first, second));
    ASSERT_EQ(samples::sorted_pairs(b.join(a)), scan_pairs(second, first));
    ASSERT_EQ(pairs_of(c.join(d)), scan_pairs(first, second));
    ASSERT_EQ(pairs_of(d.join(c)), scan_pairs(second, first));
  }
}

// The keys become coarser each time; the boxes stay what they are.
TEST(Exactness, entries_beyond_the_range_of_a_tree) {
  Entries alive = entries_of(Around{1, 1000}, 500, 1);
  Tree tree = Tree::bulk_load(alive);
  for (const double place : {1.0001, 1.5, 3.0, 100.0, -1.0, 1e-300, -1e300, kInfinity}) {
    for (const auto& [box, id] : entries_of(Around{place, 5}, 50, 2)) {
      alive.push_back({box, alive.size()});
      ASSERT_TRUE(tree.insert(box, alive.back().payload));
    }
    ASSERT_EQ(audit(tree), std::vector<std::string>{});
    for (std::size_t i = 0; i < alive.size(); i += 7)
      ASSERT_EQ(samples::window_ids(tree, alive[i].box), samples::scan(alive, alive[i].box));
  }
  ASSERT_EQ(tree.entries().size(), alive.size());
  for (const auto& entry : alive) ASSERT_TRUE(tree.erase(entry.box, entry.payload));
  ASSERT_TRUE(tree.empty());
}

}  // namespace
}  // namespace rtree
