#include "algebra3d/kernel/exact/point_table.h"

#include <gtest/gtest.h>

#include <vector>

namespace algebra3d {
namespace {

/// Doubles and thirds.
std::vector<ExactPoint> points() {
  std::vector<ExactPoint> result;
  for (int i = 0; i < 100; ++i) {
    result.emplace_back(Vec3{static_cast<double>(i), 0, 0});
    result.emplace_back(RationalVec3(Rational(i, 3) + Rational(1, 7), 0, 0));
  }
  return result;
}

TEST(PointTable, keeps_the_coordinates_of_points_that_are_gone) {
  PointTable table;
  for (const ExactPoint& point : points()) table.intern(point);
  const std::vector<ExactPoint> expected = points();
  ASSERT_EQ(table.size(), expected.size());
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(ExactPoint(table[i]), expected[i]);
    EXPECT_EQ(table.find(expected[i]), i);
  }
}

TEST(PointTable, has_its_points_when_it_is_finished) {
  PointTable table;
  const std::vector<ExactPoint> expected = points();
  for (const ExactPoint& point : expected) table.intern(point);
  table.finish();
  ASSERT_EQ(table.size(), expected.size());
  for (std::uint32_t i = 0; i < table.size(); ++i) EXPECT_EQ(ExactPoint(table[i]), expected[i]);
  // Points that come too late are found and added all the same.
  for (std::uint32_t i = 0; i < expected.size(); ++i) EXPECT_EQ(table.intern(expected[i]), i);
  EXPECT_EQ(table.intern(Vec3{0, 1, 0}), expected.size());
}

}  // namespace
}  // namespace algebra3d
