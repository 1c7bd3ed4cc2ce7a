#include "algebra3d/kernel/exact/elementary.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

// Expected values are those of Python's mpmath with 400 bits, rounded to doubles by the division of Python's integers,
// and of Python's decimal.

namespace algebra3d {
namespace {

TEST(Elementary, functions_of_one_number_are_rounded_once) {
  struct Case {
    Maybe<double> (*function)(double);
    double x, value;
  };
  const Case cases[] = {
      {&sine, 0x1.0000000000000p-1, 0x1.eaee8744b05f0p-2},
      {&sine, 0x1.0f0cf064dd592p+73, -0x1.b453ab76bf397p-1},
      {&sine, -0x1.d99999999999ap+1, 0x1.0f46aec2e1b41p-1},
      {&sine, 0x0.012688b70e62bp-1022, 0x0.012688b70e62bp-1022},
      {&sine, 0x1.921fb54442d18p+0, 0x1.0000000000000p+0},
      {&sine, 0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53},
      {&sine, -0x1.58139e19f26a6p+18, 0x1.fadba1d69d030p-1},
      {&sine, -0x1.0aefa5f6587d1p+996, -0x1.e349fd4eab048p-3},
      {&cosine, 0x1.0000000000000p-1, 0x1.c1528065b7d50p-1},
      {&cosine, 0x1.0f0cf064dd592p+73, 0x1.0be2cef01c8f4p-1},
      {&cosine, -0x1.d99999999999ap+1, -0x1.b23a2ad7dd937p-1},
      {&cosine, 0x0.012688b70e62bp-1022, 0x1.0000000000000p+0},
      {&cosine, 0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
      {&cosine, 0x1.921fb54442d18p+1, -0x1.0000000000000p+0},
      {&cosine, 0x1.26cb3c8c91e6cp+18, 0x1.d5ce82726a7ddp-1},
      {&cosine, -0x1.46e295a75a49cp+996, 0x1.9568853638aacp-1},
      {&tangent, 0x1.0000000000000p-1, 0x1.17b4f5bf3474ap-1},
      {&tangent, 0x1.0f0cf064dd592p+73, -0x1.a0f79c1b6b257p+0},
      {&tangent, -0x1.d99999999999ap+1, -0x1.3fdd037da3554p-1},
      {&tangent, 0x0.012688b70e62bp-1022, 0x0.012688b70e62bp-1022},
      {&tangent, 0x1.921fb54442d18p+0, 0x1.d02967c31cdb5p+53},
      {&tangent, 0x1.921fb54442d18p+1, -0x1.1a62633145c07p-53},
      {&tangent, 0x1.185402347c830p+16, 0x1.640a9261d6124p-1},
      {&tangent, -0x1.9abd3a4fee848p+994, -0x1.b677ee1dcecbfp+1},
      {&arc_sine, 0x1.0000000000000p-1, 0x1.0c152382d7366p-1},
      {&arc_sine, 0x1.0000000000000p+0, 0x1.921fb54442d18p+0},
      {&arc_sine, -0x1.0000000000000p+0, -0x1.921fb54442d18p+0},
      {&arc_sine, 0x1.56e1fc2f8f359p-997, 0x1.56e1fc2f8f359p-997},
      {&arc_sine, 0x1.fffffffffffffp-1, 0x1.921fb50442d18p+0},
      {&arc_sine, -0x1.c49bee0b8ed14p-1, -0x1.15984ce0ad816p+0},
      {&arc_cosine, 0x1.0000000000000p-1, 0x1.0c152382d7366p+0},
      {&arc_cosine, 0x1.0000000000000p+0, 0x0.0p+0},
      {&arc_cosine, -0x1.0000000000000p+0, 0x1.921fb54442d18p+1},
      {&arc_cosine, 0x1.56e1fc2f8f359p-997, 0x1.921fb54442d18p+0},
      {&arc_cosine, 0x1.fffffffffffffp-1, 0x1.0000000000000p-26},
      {&arc_cosine, 0x1.e74ee6deceb80p-7, 0x1.8e510e43f10c3p+0},
      {&arc_tangent, 0x1.0000000000000p-1, 0x1.dac670561bb4fp-2},
      {&arc_tangent, 0x1.7e43c8800759cp+996, 0x1.921fb54442d18p+0},
      {&arc_tangent, -0x0.00000000007e8p-1022, -0x0.00000000007e8p-1022},
      {&arc_tangent, -0x1.2800b6191fcd0p+3, -0x1.768e35df2e567p+0},
      {&exponential, 0x1.0000000000000p+0, 0x1.5bf0a8b145769p+1},
      {&exponential, -0x1.7440000000000p+9, 0x0.0000000000001p-1022},
      {&exponential, -0x1.7480000000000p+9, 0x0.0000000000001p-1022},
      {&exponential, 0x1.62c0000000000p+9, 0x1.81e9b4b52d0c9p+1023},
      {&exponential, 0x1.79ca10c924223p-67, 0x1.0000000000000p+0},
      {&exponential, -0x1.73958c43478d0p+6, 0x1.f8b85621e47dbp-135},
      {&exponential, -0x1.6820000000000p+9, 0x0.000077564144fp-1022},
      {&natural_logarithm, 0x1.4000000000000p+3, 0x1.26bb1bbb55516p+1},
      {&natural_logarithm, 0x0.0000000000001p-1022, -0x1.74385446d71c3p+9},
      {&natural_logarithm, 0x1.fffffffffffffp+1023, 0x1.62e42fefa39efp+9},
      {&natural_logarithm, 0x1.fffffffffffffp-1, -0x1.0000000000000p-53},
      {&natural_logarithm, 0x1.0000000000001p+0, 0x1.fffffffffffffp-53},
      {&natural_logarithm, 0x1.1e20b87b382e0p-4, -0x1.54a661942e2f6p+1},
      {&square_root, 0x1.0000000000000p+1, 0x1.6a09e667f3bcdp+0},
      {&square_root, 0x0.0000000000001p-1022, 0x1.0000000000000p-537},
      {&square_root, 0x0.012688b70e62bp-1022, 0x1.1297872d9cbaep-515},
      {&square_root, 0x1.fffffffffffffp+1023, 0x1.fffffffffffffp+511},
      {&square_root, 0x1.5a0aed5601e29p+26, 0x1.29a2b41df9a16p+13},
      {&radians_to_degrees, 0x1.0000000000000p+0, 0x1.ca5dc1a63c1f8p+5},
      {&radians_to_degrees, 0x1.921fb54442d18p+1, 0x1.6800000000000p+7},
      {&radians_to_degrees, 0x0.00000000007e8p-1022, 0x0.000000001c4ffp-1022},
      {&radians_to_degrees, 0x1.999999999999ap-4, 0x1.6eb167b830193p+2},
  };
  for (const Case& each : cases) {
    const auto value = each.function(each.x);
    ASSERT_TRUE(value) << each.x;
    EXPECT_EQ(*value, each.value) << &each - cases << ": " << each.x;
  }
}

TEST(Elementary, functions_of_two_numbers_are_rounded_once) {
  struct Case {
    Maybe<double> (*function)(double, double);
    double x, y, value;
  };
  const Case cases[] = {
      {&power, 0x1.000000006df38p+0, 0x1.2a05f20000000p+33, 0x1.5bf0aa93f93c0p+1},
      {&power, 0x1.0000000000000p+1, -0x1.0c80000000000p+10, 0x0.0000000000001p-1022},
      {&power, 0x1.0000000000000p+1, -0x1.0c60000000000p+10, 0x0.0000000000001p-1022},
      {&power, -0x1.8000000000000p+1, 0x1.8000000000000p+1, -0x1.b000000000000p+4},
      {&power, 0x1.999999999999ap-4, 0x1.2c80000000000p+8, 0x1.b1b7583379149p-999},
      {&power, 0x1.67e9c127b6e74p-532, 0x1.0000000000000p+1, 0x0.00000000007e8p-1022},
      {&power, 0x1.8000000000000p+1, -0x1.9166666666666p+7, 0x1.dd0f4a9907990p-319},
      {&arc_tangent_of_quotient, 0x1.0000000000000p+0, -0x1.0000000000000p+0, 0x1.2d97c7f3321d2p+1},
      {&arc_tangent_of_quotient, -0x0.012688b70e62bp-1022, 0x1.86a0000000000p+16, -0x0.000000c1069cdp-1022},
      {&arc_tangent_of_quotient, 0x1.4000000000000p+1, -0x1.7e43c8800759cp+996, 0x1.921fb54442d18p+1},
      {&arc_tangent_of_quotient, -0x1.3333333333333p-2, -0x1.6666666666666p-1, -0x1.5e4c36ca0118ap+1},
      {&logarithm, 0x1.4000000000000p+3, 0x1.8000000000000p+1, 0x1.0c468ef9537c1p+1},
      {&logarithm, 0x1.0000000000000p+10, 0x1.0000000000000p+1, 0x1.4000000000000p+3},
      {&logarithm, 0x1.f400000000000p+9, 0x1.4000000000000p+3, 0x1.8000000000000p+1},
      {&logarithm, 0x1.0624dd2f1a9fcp-10, 0x1.e000000000000p+2, -0x1.b6d390262fb7fp+1},
      {&logarithm, 0x0.0000000000001p-1022, 0x1.4000000000000p+3, -0x1.434e6420f4374p+8},
  };
  for (const Case& each : cases) {
    const auto value = each.function(each.x, each.y);
    ASSERT_TRUE(value) << each.x;
    EXPECT_EQ(*value, each.value) << &each - cases << ": " << each.x << " " << each.y;
  }
}

TEST(Elementary, degrees_become_radians) {
  EXPECT_EQ(degrees_to_radians(0x1.6800000000000p+5), 0x1.921fb54442d18p-1);
  EXPECT_EQ(degrees_to_radians(0x1.6800000000000p+6), 0x1.921fb54442d18p+0);
  EXPECT_EQ(degrees_to_radians(0x1.0000000000000p+0), 0x1.1df46a2529d39p-6);
  EXPECT_EQ(degrees_to_radians(0x1.e000000000000p+4), 0x1.0c152382d7366p-1);
  EXPECT_EQ(degrees_to_radians(0x0.0000000000002p-1022), 0x0.0p+0);
  EXPECT_EQ(degrees_to_radians(0x1.7e43c8800759cp+996), 0x1.aafe6d51317bbp+990);
  EXPECT_EQ(degrees_to_radians(-0x1.edd2f1a9fbe77p+6), -0x1.13cda86ccdd88p+1);
  EXPECT_EQ(circle_constant(), 0x1.921fb54442d18p+1);
  EXPECT_EQ(natural_constant(), 0x1.5bf0a8b145769p+1);
}

TEST(Elementary, decimal_rounding_is_that_of_the_exact_value) {
  EXPECT_EQ(*rounded_to_digits(0x1.5666666666666p+1, 2), 0x1.55c28f5c28f5cp+1);
  EXPECT_EQ(*rounded_to_digits(0x1.43ef9db22d0e5p+3, 2), 0x1.43d70a3d70a3dp+3);
  EXPECT_EQ(*rounded_to_digits(0x1.0e11f7ced9168p+12, -2), 0x1.0cc0000000000p+12);
  EXPECT_EQ(*rounded_to_digits(0x1.4000000000000p+1, 0), 0x1.8000000000000p+1);
  EXPECT_EQ(*rounded_to_digits(-0x1.4000000000000p+1, 0), -0x1.8000000000000p+1);
  EXPECT_EQ(*rounded_to_digits(0x1.0000000000000p-1, 0), 0x1.0000000000000p+0);
  EXPECT_EQ(*rounded_to_digits(0x1.0f0cf064dd592p+73, 3), 0x1.0f0cf064dd592p+73);
  EXPECT_EQ(*rounded_to_digits(0x1.d6f3457f35ba8p+26, 5), 0x1.d6f3457f35a86p+26);
  EXPECT_EQ(*rounded_to_digits(-0x1.999999999999ap-5, 1), -0x1.999999999999ap-4);
  EXPECT_EQ(*rounded_to_digits(0x0.0000000000001p-1022, 1073), 0x0.0000000000001p-1022);
  EXPECT_EQ(*rounded_to_digits(0x1.0000000000000p-3, 2), 0x1.0a3d70a3d70a4p-3);
  EXPECT_EQ(*rounded_to_digits(0x1.fffffffffffffp+1023, -300), 0x1.ffffffe8c42f7p+1023);
  EXPECT_EQ(*rounded_to_digits(0.1, std::numeric_limits<std::int64_t>::max()), 0.1);
  EXPECT_EQ(*rounded_to_digits(1e308, std::numeric_limits<std::int64_t>::min()), 0.0);
  EXPECT_FALSE(std::signbit(*rounded_to_digits(-0.3, 0)));
  EXPECT_FALSE(rounded_to_digits(1.7976931348623157e308, -308));
}

TEST(Elementary, outside_of_the_domain_they_are_undefined_with_the_reason) {
  EXPECT_EQ(square_root(-1).reason(), "-1.0 has no square root");
  EXPECT_EQ(natural_logarithm(0).reason(), "0.0 has no logarithm");
  EXPECT_EQ(logarithm(2, 1).reason(), "1.0 is not a base of logarithms");
  EXPECT_EQ(logarithm(2, -3).reason(), "-3.0 is not a base of logarithms");
  EXPECT_EQ(arc_sine(1.5).reason(), "1.5 is not a sine of an angle");
  EXPECT_EQ(arc_cosine(-1.5).reason(), "-1.5 is not a cosine of an angle");
  EXPECT_EQ(power(-8, 0.5).reason(), "-8.0 has no power with the exponent 0.5, which is not an integer");
  EXPECT_EQ(power(0, -1).reason(), "division by zero");
  EXPECT_EQ(exponential(710).reason(), "the result is beyond the range of reals");
  EXPECT_EQ(radians_to_degrees(1e308).reason(), "the result is beyond the range of reals");
  EXPECT_EQ(*power(0, 0), 1.0);
  EXPECT_EQ(*arc_tangent_of_quotient(0, 0), 0.0);
}

}  // namespace
}  // namespace algebra3d
