#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

// On small integers two different angles differ by far more than the rounding of this plain computation.
constexpr double kSameAngle = 1e-9;

// Angle of x about e0 -> e1 from the half-plane of `origin`, in [0, 2 pi), by rounded trigonometry.
double angle_about(const Vec3& e0, const Vec3& e1, const Vec3& origin, const Vec3& x) {
  const Vec3 axis = e1 - e0;
  const Vec3 side = cross(axis, origin - e0);
  const Vec3 ahead = cross(side, axis);
  const double angle =
      std::atan2(dot(x - e0, side) / std::sqrt(dot(side, side)), dot(x - e0, ahead) / std::sqrt(dot(ahead, ahead)));
  if (std::abs(angle) < kSameAngle) return 0;
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

bool off_line(const Vec3& e0, const Vec3& e1, const Vec3& p) {
  const Vec3 area = cross(e1 - e0, p - e0);
  return dot(area, area) > 0;
}

TEST(radial_order, agrees_with_angles_on_an_integer_grid) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> coordinate(-2, 2);
  const auto point = [&] {
    return Vec3{double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
  };
  int equal_count = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 e0 = point(), e1 = point(), a = point(), b = point(), c = point();
    if (e0 == e1 || !off_line(e0, e1, a) || !off_line(e0, e1, b) || !off_line(e0, e1, c)) continue;
    const double to_b = angle_about(e0, e1, a, b);
    const double to_c = angle_about(e0, e1, a, c);
    const bool same = std::abs(to_b - to_c) < kSameAngle;
    equal_count += same ? 1 : 0;
    const auto order = compare_around_edge(e0, e1, a, b, c);
    ASSERT_EQ(order == 0, same) << i;
    ASSERT_EQ(order < 0, !same && to_b < to_c) << i;
  }
  EXPECT_GT(equal_count, 100);
}

TEST(radial_order, quarter_turns_about_the_z_axis_come_in_the_right_handed_order) {
  const Vec3 e0{0, 0, 0}, e1{0, 0, 1}, east{1, 0, 0}, north{0, 1, 5}, west{-1, 0, 0}, south{0, -1, -5};
  EXPECT_TRUE(compare_around_edge(e0, e1, east, north, west) < 0);
  EXPECT_TRUE(compare_around_edge(e0, e1, east, west, south) < 0);
  EXPECT_TRUE(compare_around_edge(e1, e0, east, north, south) > 0);
}

}  // namespace
}  // namespace algebra3d
