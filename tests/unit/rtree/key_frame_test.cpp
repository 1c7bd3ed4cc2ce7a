#include <gtest/gtest.h>

#include "rtree/detail/key_frame.h"
#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::kInfinity;
using samples::kLeast;
using samples::kMax;

const std::vector<double> kAscending = {-kInfinity, -kMax,    -1e300, -2, std::nextafter(-1, -2), -1, -1e-300, -kLeast,
                                        0,          kLeast,   1e-300, 1,  std::nextafter(1, 2),   2,  1e9,     1e300,
                                        kMax,       kInfinity};

TEST(Ordered, ascends_with_the_doubles) {
  for (std::size_t i = 1; i < kAscending.size(); ++i) EXPECT_LT(ordered(kAscending[i - 1]), ordered(kAscending[i]));
  EXPECT_EQ(ordered(-0.0), 0);
  EXPECT_EQ(ordered(0.0), 0);
  EXPECT_EQ(ordered(kLeast), 1);
  EXPECT_EQ(ordered(-kLeast), -1);
  EXPECT_EQ(ordered(std::nextafter(1, 2)), ordered(1) + 1);
}

TEST(Ordered, can_be_reversed) {
  for (const double x : kAscending) EXPECT_EQ(double_at(ordered(x)), x);
  EXPECT_EQ(double_at(INT64_MAX), kInfinity);
  EXPECT_EQ(double_at(INT64_MIN), -kInfinity);
}

// Keys never contradict the order of coordinates, and with what they leave out they are exact.
void check_frame(const AxisFrame& frame, const std::vector<double>& ascending) {
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    const std::int64_t position = ordered(ascending[i]);
    const std::int32_t key = frame.key(position);
    ASSERT_LT(key, INT32_MAX);
    ASSERT_LE(frame.key(ordered(ascending[i == 0 ? 0 : i - 1])), key);
    if (!frame.has(position)) continue;
    ASSERT_EQ(frame.key_in_range(position), key);
    ASSERT_EQ(frame.position(key, frame.remainder(position)), position);
    ASSERT_LE(frame.position(key, 0), position);
    ASSERT_LE(position, frame.position(key, frame.remainders()));
  }
}

TEST(AxisFrame, has_what_it_was_made_for_and_keeps_the_order_of_all) {
  for (std::size_t low = 0; low < kAscending.size(); ++low) {
    for (std::size_t high = low; high < kAscending.size(); ++high) {
      const AxisFrame frame = AxisFrame::of(ordered(kAscending[low]), ordered(kAscending[high]));
      ASSERT_TRUE(frame.has(ordered(kAscending[low])));
      ASSERT_TRUE(frame.has(ordered(kAscending[high])));
      check_frame(frame, kAscending);
    }
  }
  check_frame(AxisFrame{}, kAscending);
}

TEST(AxisFrame, resolves_what_lies_close_together_far_from_the_origin) {
  const AxisFrame frame = AxisFrame::of(ordered(1e9), ordered(1e9 + 1));
  EXPECT_LT(frame.key(ordered(1e9 + 0.5)), frame.key(ordered(1e9 + 0.5 + 1e-6)));
  const AxisFrame single = AxisFrame::of(ordered(5), ordered(5));
  EXPECT_LT(single.key(ordered(5)), single.key(ordered(std::nextafter(5, 6))));
}

TEST(KeyFrame, widened_frames_keep_the_order_of_keys) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 1000; ++round) {
    const auto pick = [&] { return kAscending[random() % kAscending.size()]; };
    const auto box = [&] {
      Box3 result;
      for (int i = 0; i < 2; ++i) result.extend(Vec3{pick(), pick(), pick()});
      return OrderedBox::of(result);
    };
    const OrderedBox first = box(), second = box();
    const KeyFrame frame = KeyFrame::of(first);
    if (frame.has(second)) continue;
    const KeyFrame wide = frame.widened(second);
    ASSERT_TRUE(wide.has(first) && wide.has(second));
    const KeyBox keys = frame.keys_in_range(first);
    ASSERT_EQ(wide.keys_in_range(frame.outer_box(keys)), wide.keys_in_range(first));
  }
}

}  // namespace
}  // namespace rtree
