#include <gtest/gtest.h>

#include "rtree/detail/node_scan.h"
#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::Kind;

struct Sample {
  KeyFrame frame;
  KeyBoxes node;
  std::vector<OrderedBox> boxes;
};

Sample sample(std::mt19937_64& random, Kind kind) {
  Sample result;
  OrderedBox bounds{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
  for (std::size_t i = 0; i < random() % (kFanOut + 1); ++i) {
    result.boxes.push_back(OrderedBox::of(samples::random_box(random, kind)));
    bounds.extend(result.boxes.back());
  }
  if (!result.boxes.empty()) result.frame = KeyFrame::of(bounds);
  result.node.clear();
  for (std::size_t i = 0; i < result.boxes.size(); ++i)
    result.node.set_box(i, result.frame.keys_in_range(result.boxes[i]));
  return result;
}

// What is proved is true, and what is true is not lost.
TEST(NodeScan, all_give_what_boxes_say) {
  const NodeScans* scans[4];
  const std::size_t count = available_scans(scans);
  std::mt19937_64 random(1);
  for (const Kind kind : samples::kKinds) {
    for (int round = 0; round < 300; ++round) {
      const Sample node = sample(random, kind);
      const Target target(samples::random_box(random, kind), node.frame);
      for (std::size_t i = 0; i < count; ++i) {
        const Meeting meeting = scans[i]->meeting_exactly(node.node, target.keys);
        ASSERT_EQ(meeting.slots(), scans[i]->meeting(node.node, target.keys));
        ASSERT_EQ(meeting.bits, scans[0]->meeting_exactly(node.node, target.keys).bits);
        for (std::size_t slot = 0; slot < kFanOut; ++slot) {
          const bool meets = slot < node.boxes.size() && node.boxes[slot].intersects(target.exact);
          const bool is_found = (meeting.slots() >> slot & 1) != 0, is_open = (meeting.open() >> slot & 1) != 0;
          ASSERT_TRUE(is_found || !meets);
          ASSERT_TRUE(meets || !is_found || is_open);
          ASSERT_TRUE(is_found || !is_open);
        }
      }
    }
  }
}

TEST(NodeScan, rows_are_single_scans) {
  const NodeScans* scans[4];
  const std::size_t count = available_scans(scans);
  std::mt19937_64 random(2);
  for (int round = 0; round < 300; ++round) {
    const Sample first = sample(random, Kind::grid), second = sample(random, Kind::grid);
    const SlotMask rows = (SlotMask{1} << first.boxes.size()) - 1;
    for (std::size_t i = 0; i < count; ++i) {
      Meeting meetings[kFanOut];
      scans[i]->meeting_rows(first.node, rows, second.node, meetings);
      for (std::size_t row = 0; row < first.boxes.size(); ++row)
        ASSERT_EQ(meetings[row].bits, scans[0]->meeting_exactly(second.node, first.node.box(row)).bits);
    }
  }
}

// Rounded down by no more than the bits of a slot; the least one, and those within a limit.
TEST(NodeScan, ranks_are_squares_with_their_slots) {
  const NodeScans* scans[4];
  const std::size_t count = available_scans(scans);
  std::mt19937_64 random(4);
  for (const Kind kind : {Kind::uniform, Kind::clustered, Kind::points, Kind::identical, Kind::slivers, Kind::grid}) {
    for (int round = 0; round < 300; ++round) {
      const Sample node = sample(random, kind);
      const Target target(samples::random_box(random, kind), node.frame);
      double squares[kFanOut];
      scans[0]->squared_distances(node.node, target, node.frame, squares);
      const double limit = round % 3 == 0 ? samples::kInfinity : squares[random() % kFanOut];
      for (std::size_t i = 0; i < count; ++i) {
        RankedSlots ranked;
        const SlotMask near = scans[i]->rank(node.node, target, node.frame, limit, ranked);
        double least = samples::kInfinity;
        for (std::size_t slot = 0; slot < kFanOut; ++slot) {
          const double square = ranked.squares[slot];
          const bool is_used = slot < node.boxes.size();
          least = std::min(least, square);
          ASSERT_EQ(RankedSlots::slot(square), slot);
          ASSERT_EQ(near >> slot & 1, is_used && squares[slot] <= limit ? 1U : 0U);
          if (is_used) {
            ASSERT_NEAR(square, squares[slot], squares[slot] * 0x1p-48 + 1e-300);
          } else {
            ASSERT_GE(square, RankedSlots::kFarthest);
          }
        }
        ASSERT_EQ(scans[i]->least(ranked, 0xffff), least);
        ASSERT_EQ(scans[i]->least(ranked, 0), RankedSlots::kFarthest);
        const auto some = static_cast<SlotMask>(random() % 0x10000);
        least = RankedSlots::kFarthest;
        for (SlotMask slots = some; slots != 0;) least = std::min(least, ranked.squares[take_slot(slots)]);
        ASSERT_EQ(scans[i]->least(ranked, some), least);
      }
    }
  }
}

// Squares of different slots differ in their lowest bits.
TEST(NodeScan, nearest_slots_have_the_least_squares) {
  const NodeScans* scans[4];
  const std::size_t count = available_scans(scans);
  std::mt19937_64 random(6);
  for (int round = 0; round < 300; ++round) {
    RankedSlots ranked;
    for (std::size_t slot = 0; slot < kFanOut; ++slot)
      ranked.squares[slot] = std::bit_cast<double>(random() % 100 * 1000 * kFanOut + slot);
    for (std::size_t wanted = 1; wanted <= kFanOut; ++wanted) {
      std::vector<double> sorted(ranked.squares, ranked.squares + kFanOut);
      std::ranges::sort(sorted);
      SlotMask expected = 0;
      for (std::size_t i = 0; i < wanted; ++i) expected |= SlotMask{1} << RankedSlots::slot(sorted[i]);
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(scans[i]->nearest(ranked, wanted), expected);
    }
  }
}

TEST(NodeScan, lists_keep_the_least_with_their_places) {
  const NodeScans* scans[4];
  const std::size_t count = available_scans(scans);
  std::mt19937_64 random(5);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::size_t length : {8, 16, 24, 72}) {
      NearestList list;
      std::fill_n(list.squares, length, samples::kInfinity);
      std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> all;
      for (std::uint32_t node = 0; node < 20; ++node) {
        RankedSlots ranked;
        for (std::size_t slot = 0; slot < kFanOut; ++slot) {
          const auto square = std::bit_cast<std::uint64_t>(static_cast<double>(random() % 100));
          ranked.squares[slot] = std::bit_cast<double>(square | 0xff0 | slot);
        }
        const auto slots = static_cast<SlotMask>(random() % 0x10000);
        scans[i]->keep(ranked, slots, node, list, length);
        for (std::size_t slot = 0; slot < kFanOut; ++slot)
          if ((slots >> slot & 1) != 0) all.push_back({std::round(ranked.squares[slot]), {node, slot}});
        std::ranges::sort(all);
        for (std::size_t j = 0; j < length; ++j) {
          if (j >= all.size()) {
            ASSERT_EQ(list.squares[j], samples::kInfinity);
            continue;
          }
          ASSERT_EQ(std::round(list.squares[j]), all[j].first);
          ASSERT_EQ(NearestList::node(list.squares[j]), all[j].second.first);
          ASSERT_EQ(RankedSlots::slot(list.squares[j]), all[j].second.second);
        }
      }
    }
  }
}

TEST(NodeScan, bounds_are_those_of_the_node) {
  const NodeScans* scans[4];
  const std::size_t count = available_scans(scans);
  std::mt19937_64 random(7);
  for (const Kind kind : samples::kKinds) {
    const Sample node = sample(random, kind);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(scans[i]->bounds(node.node), node.node.bounds());
  }
}

TEST(NodeScan, distances_are_lower_bounds) {
  const NodeScans* scans[4];
  const std::size_t count = available_scans(scans);
  std::mt19937_64 random(3);
  for (const Kind kind : samples::kKinds) {
    for (int round = 0; round < 300; ++round) {
      const Sample node = sample(random, kind);
      const Target target(samples::random_box(random, kind), node.frame);
      double expected[kFanOut];
      scans[0]->squared_distances(node.node, target, node.frame, expected);
      for (std::size_t i = 0; i < count; ++i) {
        double squares[kFanOut];
        scans[i]->squared_distances(node.node, target, node.frame, squares);
        for (std::size_t slot = 0; slot < node.boxes.size(); ++slot) {
          ASSERT_EQ(squares[slot], expected[slot]);
          ASSERT_LE(squares[slot], squared_distance(node.boxes[slot].box(), target.box));
        }
      }
    }
  }
}

}  // namespace
}  // namespace rtree
