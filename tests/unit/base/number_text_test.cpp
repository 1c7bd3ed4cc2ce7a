#include "base/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace algebra3d {
namespace {

TEST(NumberText, shows_a_point_or_an_exponent) {
  EXPECT_EQ(real_text(8), "8.0");
  EXPECT_EQ(real_text(-0.0), "-0.0");
  EXPECT_EQ(real_text(0.1), "0.1");
  EXPECT_EQ(real_text(1e300), "1e+300");
}

TEST(NumberText, every_finite_double_reads_back) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 100'000; ++round) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const auto back = parse_real(real_text(value));
    ASSERT_TRUE(back.has_value());
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(NumberText, accepts_the_forms_of_the_language) {
  EXPECT_EQ(parse_real(".5"), 0.5);
  EXPECT_EQ(parse_real("5."), 5.0);
  EXPECT_EQ(parse_real("+5"), 5.0);
  EXPECT_EQ(parse_real("1e-3"), 0.001);
}

TEST(NumberText, refuses_what_is_no_finite_number) {
  for (const char* text : {"", "+", "-", "nan", "inf", "1e999", "1x", "++1", "+-1 ", " 1", "0x10"})
    EXPECT_FALSE(parse_real(text).has_value()) << text;
  for (const char* text : {"", "9223372036854775808", "1.0", "+", "1 "})
    EXPECT_FALSE(parse_int(text).has_value()) << text;
}

}  // namespace
}  // namespace algebra3d
