// Oracle: std::nextafter.
#include "base/next_number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace algebra3d {
namespace {

template <typename Number>
void expect_the_neighbours_of_nextafter() {
  using Limits = std::numeric_limits<Number>;
  std::vector<Number> numbers{0, Limits::denorm_min(), Limits::min(), Limits::max(), Limits::infinity(), 1, 2, 3};
  for (int exponent = Limits::min_exponent - Limits::digits; exponent < Limits::max_exponent; exponent += 7)
    for (const double factor : {1.0, 1.9, 1.999999999})
      numbers.push_back(std::ldexp(static_cast<Number>(factor), exponent));
  const auto same_bits = [](Number a, Number b) { return a == b && std::signbit(a) == std::signbit(b); };
  for (const Number size : numbers)
    for (const Number number : {size, -size}) {
      EXPECT_TRUE(same_bits(next_above(number), std::nextafter(number, Limits::infinity()))) << number;
      EXPECT_TRUE(same_bits(next_below(number), std::nextafter(number, -Limits::infinity()))) << number;
    }
}

TEST(next_number, is_what_nextafter_gives) {
  expect_the_neighbours_of_nextafter<float>();
  expect_the_neighbours_of_nextafter<double>();
}

}  // namespace
}  // namespace algebra3d
