#include "algebra3d/kernel/exact/point_text.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

std::optional<ExactPoint> point_of(const std::string& x, const std::string& y, const std::string& z,
                                   const Vec3& rounded) {
  return point_of_texts({x, y, z}, rounded);
}

TEST(PointText, fractions_and_doubles_mix) {
  const auto point = point_of("1/3", "", "-22/7", {1.0 / 3, 0.5, -22.0 / 7});
  ASSERT_TRUE(point);
  EXPECT_EQ(point->rational(), RationalVec3(Rational(1, 3), Rational(0.5), Rational(-22, 7)));
}

TEST(PointText, whole_numbers_that_are_no_doubles_are_points) {
  const auto point = point_of("9007199254740993", "", "", {9007199254740992.0, 0, 0});
  ASSERT_TRUE(point);
  EXPECT_EQ(point->rational().x, *Rational::parse("9007199254740993"));
}

TEST(PointText, terms_need_not_be_lowest) {
  const auto point = point_of("2/6", "", "", {1.0 / 3, 0, 0});
  ASSERT_TRUE(point);
  EXPECT_EQ(*point, ExactPoint(RationalVec3(Rational(1, 3), Rational(), Rational())));
}

TEST(PointText, what_is_no_number_is_no_point) {
  for (const char* text :
       {"", "-", "/", "1/", "/3", "1/0", "1/00", "+1/3", "1/-3", "1/3/5", " 1/3", "1e3", "0x1/3", "1.5/3"})
    EXPECT_FALSE(point_of(text, "", "", {1.0 / 3, 0, 0})) << text;
}

TEST(PointText, what_is_a_double_or_rounds_to_another_is_no_point) {
  EXPECT_FALSE(point_of("1/2", "1/3", "", {0.5, 1.0 / 3, 0}));
  EXPECT_FALSE(point_of("1/3", "", "", {0.25, 0, 0}));
  EXPECT_FALSE(point_of("", "", "", {1, 2, 3}));
  EXPECT_FALSE(point_of("1" + std::string(400, '0') + "/3", "", "", {1e308, 0, 0}));
}

// Numbers of all lengths about the limits of the ways in which they are read; the reference reads by GMP alone.
TEST(PointText, numbers_of_any_length_are_what_gmp_reads) {
  std::mt19937 random(7);
  const auto digits = [&](std::size_t count) {
    std::string text(1, static_cast<char>('1' + random() % 9));
    while (text.size() < count) text += static_cast<char>('0' + random() % 10);
    return text;
  };
  std::size_t read = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t length = 1 + random() % 420;
    std::array<std::string, 3> texts;
    std::array<Rational, 3> expected;
    Vec3 rounded;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      texts[axis] = (random() % 2 == 0 ? "-" : "") + digits(length) + "/" + digits(length);
      expected[axis] = *Rational::parse(texts[axis]);
      rounded[axis] = expected[axis].nearest_double();
      if (expected[axis].is_double()) texts[axis].clear();
    }
    const auto point = point_of_texts({texts[0], texts[1], texts[2]}, rounded);
    if (!point) continue;
    ++read;
    EXPECT_EQ(point->rational(), RationalVec3(expected[0], expected[1], expected[2]));
    EXPECT_EQ(*point, ExactPoint(RationalVec3(expected[0], expected[1], expected[2])));
  }
  EXPECT_GT(read, 2900U);
}

}  // namespace
}  // namespace algebra3d
