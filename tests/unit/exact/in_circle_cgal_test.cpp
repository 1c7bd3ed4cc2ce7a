// in_circle against CGAL's over GMP rationals.

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/in_circle.h"
#include "unit/exact/point_families.h"

namespace algebra3d {
namespace {

using namespace point_families;

class InCircle : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(families, InCircle, testing::ValuesIn(kFamilies));

int oracle_in_circle(const std::vector<TestPoint>& p) {
  const auto flat = [](const TestPoint& point) { return Kernel::Point_2(point.oracle.x(), point.oracle.y()); };
  return static_cast<int>(CGAL::side_of_oriented_circle(flat(p[0]), flat(p[1]), flat(p[2]), flat(p[3])));
}

TEST_P(InCircle, is_the_exact_sign) {
  Random random(4);
  int zero_count = 0;
  for (int i = 0; i < sample_count(GetParam()); ++i) {
    const auto p = make_points(GetParam(), random, 4);
    const int expected = oracle_in_circle(p);
    zero_count += expected == 0 ? 1 : 0;
    ASSERT_EQ(in_circle(p[0].ours, p[1].ours, p[2].ours, p[3].ours), expected) << "sample " << i;
    ASSERT_EQ(in_circle(p[1].ours, p[0].ours, p[2].ours, p[3].ours), -expected) << "sample " << i;
    ASSERT_EQ(in_circle(p[3].ours, p[0].ours, p[1].ours, p[2].ours), -expected) << "sample " << i;
  }
  EXPECT_GE(zero_count, GetParam() == Family::grid ? 100 : 0);
}

/// Points of a circle with integer coordinates, moved, scaled, and one of them off by its last bit now and then.
TEST(InCircleOfNearCircles, is_the_exact_sign) {
  Random random(5);
  constexpr std::array<std::array<double, 2>, 12> kCircle{
      {{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-3, 4}, {-4, 3}, {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}}};
  std::array<int, 3> counts{};
  for (const int exponent : {0, -30, 40, -200, -280, -1000, 190, 255, 1000}) {
    for (int i = 0; i < 300; ++i) {
      const double shift = static_cast<double>(integer(random, 0, 3)) * 0x1p20;
      std::vector<TestPoint> points;
      for (int k = 0; k < 4; ++k) {
        const auto& [x, y] = kCircle[static_cast<std::size_t>(integer(random, 0, 11))];
        const int ulps = integer(random, 0, 5) == 0 ? integer(random, -1, 1) : 0;
        points.emplace_back(Vec3{std::ldexp(moved_by_ulps(x + shift, ulps), exponent), std::ldexp(y - shift, exponent),
                                 static_cast<double>(k)});
      }
      const int expected = oracle_in_circle(points);
      ++counts[static_cast<std::size_t>(expected + 1)];
      ASSERT_EQ(in_circle(points[0].ours, points[1].ours, points[2].ours, points[3].ours), expected)
          << "exponent " << exponent << ", sample " << i;
    }
  }
  for (const int count : counts) EXPECT_GE(count, 100);
}

TEST(InCircleOfWideRanges, needs_more_than_sixty_bits) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    std::vector<TestPoint> points;
    const double far = std::ldexp(1, integer(random, -90, 90));
    // Corners of a rectangle, whose circle holds all four, or all but one.
    const double x0 = real(random), y0 = real(random), x1 = far * real(random), y1 = far * real(random);
    points.emplace_back(Vec3{x0, y0, 0});
    points.emplace_back(Vec3{x1, y0, 0});
    points.emplace_back(Vec3{x1, y1, 0});
    points.emplace_back(Vec3{moved_by_ulps(x0, integer(random, -1, 1)), y1, 0});
    ASSERT_EQ(in_circle(points[0].ours, points[1].ours, points[2].ours, points[3].ours), oracle_in_circle(points))
        << "sample " << i;
  }
}

}  // namespace
}  // namespace algebra3d
