#include "algebra3d/kernel/exact/real_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

Rational sum_of(const std::vector<double>& values) {
  RealSum sum;
  for (const double value : values) sum.add(value);
  EXPECT_EQ(sum.count(), values.size());
  return sum.total();
}

TEST(RealSum, sums_are_exact_at_both_ends_of_the_range) {
  EXPECT_EQ(sum_of({}), Rational());
  EXPECT_EQ(sum_of({-0.0}), Rational());
  EXPECT_EQ(sum_of({1e308, 1e308, -1e308}), Rational(1e308));
  EXPECT_EQ(sum_of({kMax, kMax, kMax}), Rational(3) * Rational(kMax));
  EXPECT_EQ(sum_of({-kMax, kLeast, -kMax, kMax}), Rational(kLeast) - Rational(kMax));
  EXPECT_EQ(sum_of({-kLeast, -kLeast}), Rational(-2 * kLeast));
  EXPECT_EQ(sum_of({1, 1e300, 1e-300, -1e300, -1}), Rational(1e-300));
}

// The oracle is the rational sum, in another order.
TEST(RealSum, sums_of_any_doubles_are_those_of_rationals) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> values;
    Rational expected;
    while (values.size() < 30) {
      const double value = std::bit_cast<double>(random());
      if (!std::isfinite(value)) continue;
      values.push_back(value);
      if (round % 2 == 0) values.push_back(std::nextafter(-value, 0));
    }
    for (const double value : values) expected += Rational(value);
    std::ranges::shuffle(values, random);
    EXPECT_EQ(sum_of(values), expected);
  }
}

TEST(RealSum, sums_of_parts_make_the_sum_of_all) {
  RealSum large, small, none;
  for (const double value : {kMax, 1.0, kMax}) large.add(value);
  for (const double value : {kLeast, -kMax, 2.0}) small.add(value);
  large.add(small);
  large.add(none);
  EXPECT_EQ(large.count(), 6U);
  EXPECT_EQ(large.total(), Rational(kMax) + Rational(3) + Rational(kLeast));
  none.add(large);
  none.add(none);
  EXPECT_EQ(none.count(), 12U);
  EXPECT_EQ(none.total(), Rational(2) * large.total());
}

}  // namespace
}  // namespace algebra3d
