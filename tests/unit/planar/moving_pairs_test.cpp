// Pairs of moving segments by boxes, against all pairs.
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/planar/detail/moving_pairs.h"

namespace algebra3d::moving_pairs_tests {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Pairs pairs_of(const std::vector<MovingSegment>& segments) {
  Pairs pairs;
  MovingPairs(segments).for_each([&](std::uint32_t i, std::uint32_t j) {
    EXPECT_LT(i, j);
    EXPECT_TRUE(pairs.emplace(i, j).second);
    return true;
  });
  return pairs;
}

MovingPoint moving(double x1, double y1, double x2, double y2) {
  return {Vec3{x1, y1, 0}, Vec3{x2, y2, 0}};
}

TEST(moving_pairs, miss_no_segments_that_meet) {
  std::mt19937 random(21);
  std::size_t meeting = 0, found = 0, all = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<MovingSegment> segments;
    const unsigned size = 4U + static_cast<unsigned>(round);
    const auto any = [&] { return static_cast<double>(random() % size); };
    const auto near = [&](double x) { return x + static_cast<double>(random() % 4); };
    for (int i = 0; i < 60; ++i) {
      const double x1 = any(), y1 = any(), x2 = any(), y2 = any();
      const MovingSegment segment{moving(x1, y1, x2, y2), moving(near(x1), near(y1), near(x2), near(y2))};
      if (!vanishing(segment)) segments.push_back(segment);
    }
    const Pairs pairs = pairs_of(segments);
    found += pairs.size();
    all += segments.size() * (segments.size() - 1) / 2;
    for (std::uint32_t i = 0; i < segments.size(); ++i)
      for (std::uint32_t j = i + 1; j < segments.size(); ++j) {
        if (!first_clash(segments[i], segments[j], false)) continue;
        ++meeting;
        EXPECT_TRUE(pairs.contains({i, j})) << i << " " << j;
      }
  }
  EXPECT_GT(meeting, 1000U);
  EXPECT_LT(found, 3 * all / 4);
}

TEST(moving_pairs, of_what_moves_far_together_are_those_of_what_stays) {
  std::vector<MovingSegment> still, moved;
  for (int i = 0; i < 2000; ++i) {
    const double x = 3.0 * i;
    still.push_back({moving(x, 0, x, 0), moving(x + 4, 1, x + 4, 1)});
    moved.push_back({moving(x, 0, x + 1e7, 5e6), moving(x + 4, 1, x + 4 + 1e7, 1 + 5e6)});
  }
  EXPECT_EQ(pairs_of(still).size(), 1999U);
  EXPECT_EQ(pairs_of(moved).size(), 1999U);
}

TEST(moving_pairs, that_pass_each_other_are_apart_along_one_axis_after_the_other) {
  // The gap along y closes when the one along x has opened.
  const std::vector<MovingSegment> segments{{moving(0, 0, 0, 0), moving(1, 0, 1, 0)},
                                            {moving(0, 3, 4, -1), moving(1, 3, 5, -1)}};
  EXPECT_TRUE(pairs_of(segments).empty());
  const std::vector<MovingSegment> meeting{{moving(0, 0, 0, 0), moving(1, 0, 1, 0)},
                                           {moving(0, 3, 1, -1), moving(1, 3, 2, -1)}};
  EXPECT_EQ(pairs_of(meeting).size(), 1U);
}

TEST(moving_pairs, near_the_limits_of_doubles_are_kept) {
  const double huge = 1.7e308;
  const std::vector<MovingSegment> segments{{moving(-huge, 0, huge, 0), moving(-huge, 1, huge, 1)},
                                            {moving(huge, 0, -huge, 0), moving(huge, 1, -huge, 1)}};
  EXPECT_EQ(pairs_of(segments).size(), 1U);
  EXPECT_TRUE(pairs_of({}).empty());
}

}  // namespace
}  // namespace algebra3d::moving_pairs_tests
