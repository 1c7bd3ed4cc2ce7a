#include "algebra3d/base/box3.h"

#include <limits>
#include <sstream>
#include <unordered_set>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

const Box3 kUnit{{0, 0, 0}, {1, 1, 1}};

TEST(Box3, default_is_empty_and_neutral) {
  EXPECT_TRUE(Box3{}.is_empty());
  EXPECT_EQ(unite(Box3{}, kUnit), kUnit);
  EXPECT_TRUE(kUnit.contains(Box3{}));
  EXPECT_FALSE(Box3{}.intersects(kUnit));
}

TEST(Box3, is_printed_and_hashed_as_its_corners) {
  std::ostringstream out;
  out << Vec3{1, 0.1, -1e300} << " " << Box3{{0, 0, 0}, {1, 2.5, 3}};
  EXPECT_EQ(out.str(), "(1.0 0.1 -1e+300) ((0.0 0.0 0.0) (1.0 2.5 3.0))");
  const std::unordered_set<Vec3> points{{0, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(points.size(), 3U);
  const std::unordered_set<Box3> boxes{kUnit, {{-0.0, 0, 0}, {1, 1, 1}}, Box3(), Box3::of({0, 0, 0})};
  EXPECT_EQ(boxes.size(), 3U);
}

TEST(Box3, touching_boxes_meet) {
  const Box3 corner{{1, 1, 1}, {2, 2, 2}};
  EXPECT_TRUE(kUnit.intersects(corner));
  EXPECT_EQ(intersect(kUnit, corner), Box3::of({1, 1, 1}));
  EXPECT_EQ(distance(kUnit, corner), 0);
}

TEST(Box3, distance_is_that_of_the_nearest_points) {
  EXPECT_EQ(distance(kUnit, {{4, 5, 0}, {5, 6, 1}}), 5);
  EXPECT_EQ(squared_distance(kUnit, {{4, 5, 0}, {5, 6, 1}}), 25);
  EXPECT_EQ(distance(kUnit, Box3::of({0.5, 0.5, 1e300})), 1e300);
  const Box3 far = Box3::of({-1.5e308, -1.5e308, -1.5e308}), farther = Box3::of({1.5e308, 1.5e308, 1.5e308});
  EXPECT_EQ(distance(far, farther), std::numeric_limits<double>::infinity());
}

TEST(Box3, its_length_unit_is_near_its_size) {
  EXPECT_EQ(length_unit({{0, 0, 0}, {1, 5, 2}}), 4);
  EXPECT_EQ(length_unit({{-3, 0, 0}, {3, 0, 0}}), 4);
  EXPECT_EQ(length_unit({{-1.7e308, 0, 0}, {1.7e308, 0, 0}}), 0x1p1020);
  for (const double side : {0.0, 5e-324, 1e-322}) EXPECT_EQ(length_unit({{0, 0, 0}, {side, 0, 0}}), 0x1p-1070);
}

TEST(Box3, separate_boxes_have_no_common_part) {
  EXPECT_TRUE(intersect(kUnit, {{2, 0, 0}, {3, 1, 1}}).is_empty());
}

}  // namespace
}  // namespace algebra3d
