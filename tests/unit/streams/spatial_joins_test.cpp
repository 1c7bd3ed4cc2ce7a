// Spatial joins with little work memory and with any number of threads. The oracle is a loop over all pairs of boxes.
#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "algebra3d/values/types/spatial.h"
#include "base/scheduler.h"
#include "base/work_memory.h"
#include "queries/streams/detail/join_condition.h"
#include "queries/streams/detail/nearest_join.h"
#include "queries/streams/detail/refined_join.h"
#include "queries/streams/detail/spatial_pairs.h"
#include "support/rounds.h"
#include "unit/streams/stream_fixture.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::WorkMemory;
using Numbers = std::vector<std::pair<std::int64_t, std::int64_t>>;

constexpr std::size_t kNumber = 0, kBox = 1, kSize = 2;

/// Boxes with integer corners, so that squares of distances are exact.
class SpatialJoins : public StreamTest {
 protected:
  std::vector<Box3> random_boxes(std::size_t count, int extent) {
    std::vector<Box3> boxes(count);
    for (Box3& box : boxes)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] = static_cast<double>(random_() % static_cast<unsigned>(extent));
        box.max[axis] = box.min[axis] + static_cast<double>(random_() % 4);
      }
    return boxes;
  }
  static TupleStreamPtr stream_of(const std::vector<Box3>& boxes) {
    return make_stream([&boxes, next = std::size_t{0}]() mutable -> Result<TuplePtr> {
      if (next == boxes.size()) return TuplePtr();
      Tuple tuple{{Value::of(static_cast<std::int64_t>(next)), Value::of(boxes[next])}};
      ++next;
      return TuplePtr(std::make_shared<const Tuple>(std::move(tuple)));
    });
  }
  TupleBuffer buffer_of(const std::vector<Box3>& boxes) { return *buffered(*stream_of(boxes), context); }

  /// The numbers of the boxes in each pair.
  Numbers numbers(TupleStream& pairs) {
    Numbers result;
    const Status status = for_each_tuple(pairs, context, [&](const TuplePtr& tuple) -> Status {
      result.emplace_back(tuple->attributes[kNumber].get<std::int64_t>(),
                          tuple->attributes[kSize + kNumber].get<std::int64_t>());
      return {};
    });
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().text());
    return result;
  }
  Numbers self_joined(const std::vector<Box3>& boxes) {
    auto pairs = box_pairs_within(
        {stream_of(boxes), kBox}, [](const Box3& box) { return box; }, context);
    return numbers(*refined_join(pairs, {kBox, kBox}, predicate_test("intersects", true), context));
  }
  /// The pairs whose boxes meet if the second has `reach` more on each side.
  Numbers joined(const std::vector<Box3>& builds, const std::vector<Box3>& probes, double reach) {
    const auto window = [reach](const Box3& box) {
      const algebra3d::Vec3 more{reach, reach, reach};
      return Box3{box.min - more, box.max + more};
    };
    return numbers(
        *concatenated_pairs(box_pairs({stream_of(builds), kBox}, {stream_of(probes), kBox}, window, context)));
  }
  Numbers nearest(const std::vector<Box3>& probes, const std::vector<Box3>& partners, std::size_t count) {
    return numbers(*nearest_join(stream_of(probes), buffer_of(partners), {kBox, kBox, count}, context));
  }

  std::mt19937 random_{18};
};

Numbers meeting_pairs(const std::vector<Box3>& boxes) {
  Numbers result;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (boxes[a].intersects(boxes[b])) result.emplace_back(a, b);
  return result;
}

Numbers nearest_pairs(const std::vector<Box3>& probes, const std::vector<Box3>& partners, std::size_t count) {
  Numbers result;
  for (std::size_t a = 0; a < probes.size(); ++a) {
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t b = 0; b < partners.size(); ++b) all.emplace_back(squared_distance(probes[a], partners[b]), b);
    std::ranges::sort(all);
    for (std::size_t k = 0; k < std::min(count, all.size()); ++k) result.emplace_back(a, all[k].second);
  }
  return result;
}

TEST_F(SpatialJoins, find_each_pair_once) {
  const auto boxes = random_boxes(1500, 40);
  EXPECT_EQ(self_joined(boxes), meeting_pairs(boxes));
}

TEST_F(SpatialJoins, find_the_same_pairs_in_the_same_order_with_little_memory) {
  WorkMemory memory(1, WorkMemory::default_folder());
  // Spread, in one line, and so that none can be told from another by planes.
  std::vector<std::vector<Box3>> sets{random_boxes(1500, 50), random_boxes(350, 1)};
  sets.push_back(random_boxes(1500, 1500));
  for (Box3& box : sets.back()) box.min.y = box.min.z = 0, box.max.y = box.max.z = 1;
  for (std::vector<Box3>& boxes : sets) {
    for (std::size_t i = 0; i < boxes.size(); i += 97)
      boxes[i] = i % 2 == 0 ? Box3{} : Box3{{-9, -9, -9}, {60, 60, 60}};
    context.memory = nullptr;
    const Numbers expected = self_joined(boxes), two_sided = joined(boxes, sets.front(), 2);
    EXPECT_EQ(expected, meeting_pairs(boxes));
    context.memory = &memory;
    EXPECT_EQ(self_joined(boxes), expected);
    EXPECT_EQ(joined(boxes, sets.front(), 2), two_sided);
  }
}

TEST_F(SpatialJoins, find_the_nearest_partners) {
  const auto probes = random_boxes(300, 40), partners = random_boxes(400, 40);
  EXPECT_EQ(nearest(probes, partners, 7), nearest_pairs(probes, partners, 7));
  EXPECT_EQ(nearest(probes, partners, 1), nearest_pairs(probes, partners, 1));
}

TEST_F(SpatialJoins, find_the_nearest_partners_with_little_memory) {
  WorkMemory memory(1, WorkMemory::default_folder());
  context.memory = &memory;
  const auto probes = random_boxes(200, 60), partners = random_boxes(2000, 60);
  EXPECT_EQ(nearest(probes, partners, 5), nearest_pairs(probes, partners, 5));
}

// The boxes are few different ones, so that most distances occur many times, 0 among them.
TEST_F(SpatialJoins, find_the_nearest_partners_among_equal_distances) {
  for (const int extent : {1, 2, 9}) {
    const auto probes = random_boxes(algebra3d::rounds(15U), extent), partners = random_boxes(600, extent);
    for (const std::size_t count : {1, 5, 100})
      EXPECT_EQ(nearest(probes, partners, count), nearest_pairs(probes, partners, count));
    auto away = partners;
    for (Box3& box : away) box.min.x += 20, box.max.x += 20;
    EXPECT_EQ(nearest(probes, away, 3), nearest_pairs(probes, away, 3));
  }
}

TEST_F(SpatialJoins, find_the_closest_pair) {
  for (int round = 0; round < 20; ++round) {
    const auto probes = random_boxes(40, 200), partners = random_boxes(60, 200);
    std::tuple<double, std::size_t, std::size_t> best{Box3::kInfinity, 0, 0};
    for (std::size_t a = 0; a < probes.size(); ++a)
      for (std::size_t b = 0; b < partners.size(); ++b)
        best = std::min(best, {squared_distance(probes[a], partners[b]), a, b});
    const Numbers expected{{std::get<1>(best), std::get<2>(best)}};
    EXPECT_EQ(numbers(*closest_pair(stream_of(probes), buffer_of(partners), {kBox, kBox, 1}, context)), expected);
  }
}

TEST_F(SpatialJoins, do_not_depend_on_threads) {
  const auto boxes = random_boxes(1000, 30), partners = random_boxes(500, 30);
  std::set<Numbers> pairs, neighbours;
  for (const int threads : {1, 2, 16})
    algebra3d::with_threads(threads, [&] {
      pairs.insert(self_joined(boxes));
      neighbours.insert(nearest(boxes, partners, 3));
    });
  EXPECT_EQ(pairs.size(), 1U);
  EXPECT_EQ(neighbours.size(), 1U);
}

TEST_F(SpatialJoins, count_how_pairs_were_decided) {
  const std::vector<Box3> boxes{{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}, {{2, 2, 2}, {4, 4, 4}}};
  auto pairs = box_pairs_within(
      {stream_of(boxes), kBox}, [](const Box3& box) { return box; }, context);
  const TupleStreamPtr joined = refined_join(pairs, {kBox, kBox}, predicate_test("inside", true), context);
  EXPECT_TRUE(numbers(*joined).empty());
  const std::vector<StageCount> stages = joined->stages();
  EXPECT_EQ(stages.at(0).count, 3U);  // pairs of boxes
  EXPECT_EQ(stages.at(1).count, 3U);  // decided by them: none lies in another
}

TEST_F(SpatialJoins, stop_when_they_are_cancelled) {
  std::atomic<bool> cancel = true;
  context.cancel = &cancel;
  const auto boxes = random_boxes(10, 3);
  const TupleStreamPtr joined =
      nearest_join(stream_of(boxes), TupleBuffer(std::vector<TuplePtr>()), {kBox, kBox, 1}, context);
  const Result<TuplePtr> next = joined->next();
  ASSERT_FALSE(next.ok());
  EXPECT_EQ(next.error().code, ErrorCode::interrupted);
}

TEST(MortonOrder, goes_along_the_curve) {
  std::vector<Box3> boxes;
  for (const double x : {3.0, 0.0, 1.0, 2.0}) boxes.push_back(Box3::of({x, 0, 0}));
  EXPECT_EQ(morton_order(boxes), (std::vector<std::uint32_t>{1, 2, 3, 0}));
  EXPECT_TRUE(morton_order({}).empty());
}

}  // namespace
}  // namespace queries
