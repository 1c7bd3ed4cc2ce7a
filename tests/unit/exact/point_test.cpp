#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {
namespace {

const Rational kThird(1, 3);

TEST(exact_point, holds_no_exact_part_if_all_coordinates_are_doubles) {
  const ExactPoint point(RationalVec3(Rational(1, 4), 2, Rational(-3, 8)));
  EXPECT_TRUE(point.is_double());
  EXPECT_EQ(point.approx(), (Vec3{0.25, 2, -0.375}));
  EXPECT_EQ(point, ExactPoint(Vec3{0.25, 2, -0.375}));
  EXPECT_EQ(point.hash(), ExactPoint(Vec3{0.25, 2, -0.375}).hash());
}

TEST(exact_point, rounds_to_nearest_and_keeps_the_exact_value) {
  const ExactPoint point(RationalVec3(kThird, 2, 0));
  EXPECT_FALSE(point.is_double());
  EXPECT_EQ(point.approx().x, 1.0 / 3.0);
  EXPECT_EQ(point.rational().x, kThird);
  EXPECT_NE(point, ExactPoint(point.approx())) << "a third is not a double";
  // 1/3 as a double is 6004799503160661 * 2^-54, which is below 1/3.
  EXPECT_GT(point, ExactPoint(point.approx()));
}

TEST(exact_point, stores_negative_zero_as_zero) {
  const ExactPoint point(Vec3{-0.0, 1, -0.0});
  EXPECT_FALSE(std::signbit(point.approx().x));
  EXPECT_EQ(point.hash(), ExactPoint(Vec3{0, 1, 0}).hash());
  const PointArray array(std::vector<Vec3>{{-0.0, 1, -0.0}});
  EXPECT_FALSE(std::signbit(array.approx()[0].z));
}

TEST(exact_point, order_is_lexicographic_by_exact_coordinates) {
  const double above = std::nextafter(1.0 / 3.0, 1.0);
  const std::vector<ExactPoint> ascending{ExactPoint(Vec3{-1, 9, 9}),
                                          ExactPoint(Vec3{1.0 / 3.0, 9, 9}),
                                          ExactPoint(RationalVec3(kThird, 0, 0)),
                                          ExactPoint(RationalVec3(kThird, 0, kThird)),
                                          ExactPoint(RationalVec3(kThird, kThird, 0)),
                                          ExactPoint(Vec3{above, 0, 0})};
  for (std::size_t i = 0; i < ascending.size(); ++i)
    for (std::size_t j = 0; j < ascending.size(); ++j) {
      EXPECT_EQ(ascending[i] < ascending[j], i < j) << i << " " << j;
      EXPECT_EQ(ascending[i] == ascending[j], i == j) << i << " " << j;
    }
}

TEST(exact_point, equal_values_from_different_sources_have_equal_hashes) {
  const ExactPoint a(RationalVec3(kThird, Rational(2, 6), 1));
  const ExactPoint b(RationalVec3(Rational(4, 12), kThird, Rational(5, 5)));
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_NE(a.hash(), ExactPoint(a.approx()).hash());
}

TEST(point_array, costs_24_bytes_per_point_if_all_are_doubles) {
  PointArray array;
  array.reserve(100);
  for (int i = 0; i < 100; ++i) array.push_back(Vec3{double(i), 0, 0});
  EXPECT_EQ(array.heap_bytes(), 2400U);
  EXPECT_EQ(array.exact_count(), 0U);
}

TEST(point_array, finds_its_exact_points_among_the_doubles) {
  PointArray array;
  for (int i = 0; i < 20; ++i) {
    const Rational x(i, 3);
    array.push_back(ExactPoint(RationalVec3(x, 1, 0)));
  }
  EXPECT_EQ(array.exact_count(), 13U) << "7 of 0..19 are multiples of 3";
  const PointArray copy = array;
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(copy[i].is_double(), i % 3 == 0);
    EXPECT_EQ(copy[i].rational().x, Rational(static_cast<std::int64_t>(i), 3));
    EXPECT_EQ(copy.point(i), array.point(i));
  }
  EXPECT_EQ(copy, array);
  EXPECT_EQ(copy[1].exact, array[1].exact) << "copies share";
}

TEST(box_of, encloses_the_exact_point_and_no_more) {
  const Box3 exact_box = box_of(ExactPoint(Vec3{1, 2, 3}));
  EXPECT_EQ(exact_box, Box3::of(Vec3{1, 2, 3}));
  const Box3 box = box_of(ExactPoint(RationalVec3(kThird, Rational(-1, 3), 3)));
  EXPECT_EQ(box.min, (Vec3{1.0 / 3.0, -std::nextafter(1.0 / 3.0, 1.0), 3}));
  EXPECT_EQ(box.max, (Vec3{std::nextafter(1.0 / 3.0, 1.0), -1.0 / 3.0, 3}));
}

TEST(point_array, appends_any_part_of_another_one_and_owns_its_exact_points) {
  // Exact points with doubles before, between and behind them.
  const auto is_exact = [](std::size_t i) { return i >= 5 && i < 40 && i % 3 != 0; };
  const auto point = [&](std::size_t i) {
    return ExactPoint(RationalVec3(Rational(i), is_exact(i) ? kThird : Rational(7), Rational(1)));
  };
  for (const std::size_t first : {0U, 4U, 5U, 6U, 20U, 41U})
    for (const std::size_t count : {0U, 1U, 2U, 19U, 30U}) {
      std::size_t exact = 1;
      PointArray result;
      result.push_back(Vec3{9, 9, 9});
      {
        PointArray source;
        for (std::size_t i = 0; i < 80; ++i) source.push_back(point(i));
        result.append(source, first, count);
        result.append(source, 6, 2);
      }
      result.push_back(ExactPoint(RationalVec3(kThird, 0, 0)));
      ASSERT_EQ(result.size(), count + 4);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(result.point(1 + i), point(first + i));
        exact += is_exact(first + i) ? 1 : 0;
      }
      for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(result.point(1 + count + i), point(6 + i));
      EXPECT_EQ(result.point(count + 3).rational().x, kThird);
      EXPECT_EQ(result.exact_count(), exact + 1) << "of the second part, 7 is exact and 6 is not";
    }
}

}  // namespace
}  // namespace algebra3d
