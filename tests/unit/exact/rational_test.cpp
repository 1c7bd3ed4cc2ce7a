#include "algebra3d/kernel/exact/rational.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmp.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include "algebra3d/kernel/exact/counters.h"
#include "support/rounds.h"

namespace algebra3d {
namespace {

constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kTiniest = std::numeric_limits<double>::denorm_min();

/// A GMP number that follows the same computation: the oracle.
class Oracle {
 public:
  Oracle() { mpq_init(value_); }
  explicit Oracle(const std::string& text) : Oracle() {
    EXPECT_EQ(mpq_set_str(value_, text.c_str(), 10), 0) << text;
    mpq_canonicalize(value_);
  }
  explicit Oracle(const Rational& number) : Oracle(number.text()) {}
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;
  ~Oracle() { mpq_clear(value_); }

  mpq_ptr get() { return value_; }
  std::string text() const {
    char* digits = mpq_get_str(nullptr, 10, value_);
    std::string result(digits);
    free(digits);  // NOLINT: GMP's default allocator is malloc
    return result;
  }
  /// The double nearest in the given direction, subnormals and overflow by MPFR's own emulation.
  double rounded(mpfr_rnd_t mode) {
    const mpfr_exp_t lowest = mpfr_get_emin();
    const mpfr_exp_t highest = mpfr_get_emax();
    mpfr_set_emin(-1073);
    mpfr_set_emax(1024);
    mpfr_t number;
    mpfr_init2(number, 53);
    const int inexact = mpfr_set_q(number, value_, mode);
    mpfr_subnormalize(number, inexact, mode);
    const double result = mpfr_get_d(number, mode);
    mpfr_clear(number);
    mpfr_set_emin(lowest);
    mpfr_set_emax(highest);
    return result;
  }

 private:
  mpq_t value_;
};

/// Random numbers of all sizes: around the 64-bit limits, beyond them, short ones, extremes of doubles.
class NumberSource {
 public:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

  std::int64_t integer() {
    switch (below(4)) {
      case 0:
        return static_cast<std::int64_t>(below(21)) - 10;
      case 1:
        return static_cast<std::int64_t>(random_());
      case 2:
        return below(2) == 0 ? kLowest + static_cast<std::int64_t>(below(3))
                             : kHighest - static_cast<std::int64_t>(below(3));
      default:
        return static_cast<std::int64_t>(random_() >> below(64));
    }
  }

  double any_double() {
    const std::int64_t mantissa = static_cast<std::int64_t>(random_()) >> (11 + below(53));
    return std::ldexp(static_cast<double>(mantissa), static_cast<int>(below(2045)) - 1074);
  }

  std::string digits(std::uint64_t limit) {
    std::string result(1, static_cast<char>('1' + below(9)));
    for (std::uint64_t count = below(limit); count > 0; --count) result += static_cast<char>('0' + below(10));
    return result;
  }

  Rational number() {
    switch (below(6)) {
      case 0:
        return integer();
      case 1:
      case 2: {
        const std::int64_t denominator = integer();
        return {integer(), denominator == 0 ? 1 : denominator};
      }
      case 3:
        return Rational(any_double());
      case 4:
        return Rational(
            std::ldexp(static_cast<double>(static_cast<std::int32_t>(random_())), -static_cast<int>(below(40))));
      default:
        return *Rational::parse((below(2) == 0 ? "-" : "") + digits(60) + "/" + digits(60));
    }
  }

 private:
  std::mt19937_64 random_{20240817};
};

TEST(Rational, small_values_have_the_text_that_one_expects) {
  EXPECT_EQ(Rational().text(), "0");
  EXPECT_EQ(Rational(-7).text(), "-7");
  EXPECT_EQ(Rational(6, -4).text(), "-3/2");
  EXPECT_EQ(Rational(0, -4).text(), "0");
  EXPECT_EQ(Rational(0.75).text(), "3/4");
  EXPECT_EQ(Rational(-0.0).text(), "0");
  EXPECT_EQ(Rational(std::numeric_limits<std::uint64_t>::max()).text(), "18446744073709551615");
  EXPECT_EQ(Rational(0x1p64).text(), "18446744073709551616");
  EXPECT_EQ(Rational(0x1p-64).text(), "1/18446744073709551616");
}

TEST(Rational, the_lowest_integer_is_no_special_case) {
  const Rational lowest(kLowest);
  EXPECT_TRUE(lowest.is_small());
  EXPECT_EQ(lowest.text(), "-9223372036854775808");
  EXPECT_EQ((-lowest).text(), "9223372036854775808");
  EXPECT_FALSE((-lowest).is_small());
  EXPECT_EQ(-(-lowest), lowest);
  EXPECT_TRUE((-(-lowest)).is_small());
  EXPECT_EQ(Rational(kLowest, kLowest), Rational(1));
  EXPECT_EQ(Rational(1, kLowest).text(), "-1/9223372036854775808");
  EXPECT_EQ((lowest / lowest).text(), "1");
  EXPECT_EQ((lowest * lowest).text(), "85070591730234615865843651857942052864");
  EXPECT_EQ((lowest + lowest).text(), "-18446744073709551616");
  EXPECT_EQ((Rational(0) - lowest).text(), "9223372036854775808");
  EXPECT_EQ((Rational(1) / lowest).text(), "-1/9223372036854775808");
  EXPECT_EQ((Rational(1) / (Rational(1) / lowest)), lowest);
  EXPECT_LT(lowest, Rational(kHighest));
  EXPECT_EQ(Rational(-0x1p63), lowest);
  EXPECT_TRUE(Rational(-0x1p63).is_small());
}

TEST(Rational, moves_leave_zero_and_copies_are_independent) {
  for (const Rational& value : {Rational(5, 3), *Rational::parse("1e40")}) {
    Rational first = value;
    Rational second = std::move(first);
    EXPECT_EQ(first, Rational());  // NOLINT(bugprone-use-after-move): that is the question
    EXPECT_EQ(second, value);
    first = std::move(second);
    EXPECT_EQ(second, Rational());  // NOLINT(bugprone-use-after-move)
    Rational third = *Rational::parse("1/123456789012345678901234567890");
    third = first;
    first += Rational(1);
    EXPECT_EQ(third, value);
    EXPECT_EQ(first - third, Rational(1));
    Rational& alias = third;
    third = alias;
    third = std::move(alias);
    EXPECT_EQ(third, value);
  }
}

TEST(Rational, arithmetic_and_order_agree_with_gmp) {
  NumberSource source;
  for (int round = 0; round < 40'000; ++round) {
    const Rational a = source.number();
    const Rational b = source.number();
    Oracle s(a);
    Oracle t(b);
    Oracle expected;
    mpq_add(expected.get(), s.get(), t.get());
    ASSERT_EQ((a + b).text(), expected.text()) << a.text() << " " << b.text();
    mpq_sub(expected.get(), s.get(), t.get());
    ASSERT_EQ((a - b).text(), expected.text()) << a.text() << " " << b.text();
    mpq_mul(expected.get(), s.get(), t.get());
    ASSERT_EQ((a * b).text(), expected.text()) << a.text() << " " << b.text();
    if (b.sign() != 0) {
      mpq_div(expected.get(), s.get(), t.get());
      ASSERT_EQ((a / b).text(), expected.text()) << a.text() << " " << b.text();
    }
    mpq_neg(expected.get(), s.get());
    ASSERT_EQ((-a).text(), expected.text());
    const int order = mpq_cmp(s.get(), t.get());
    ASSERT_EQ(a <=> b, order <=> 0) << a.text() << " " << b.text();
    ASSERT_EQ(a == b, order == 0);
    ASSERT_EQ(a.sign(), mpq_sgn(s.get()));
    ASSERT_EQ(a.is_integer(), mpz_cmp_ui(mpq_denref(s.get()), 1) == 0);
  }
}

TEST(Rational, field_laws_hold_and_equal_values_are_held_equally) {
  NumberSource source;
  for (int round = 0; round < 10'000; ++round) {
    const Rational a = source.number();
    const Rational b = source.number();
    const Rational c = source.number();
    ASSERT_EQ((a + b) + c, a + (b + c));
    ASSERT_EQ((a * b) * c, a * (b * c));
    ASSERT_EQ(a * (b + c), a * b + a * c);
    const Rational back = (a + b) - b;
    ASSERT_EQ(back, a);
    ASSERT_EQ(back.is_small(), a.is_small());
    ASSERT_EQ(back.hash(), a.hash());
    if (b.sign() != 0) {
      ASSERT_EQ(a / b * b, a);
      ASSERT_EQ((a * b / b).hash(), a.hash());
    }
  }
}

TEST(Rational, text_reads_back_to_the_same_number) {
  NumberSource source;
  for (int round = 0; round < 20'000; ++round) {
    const Rational a = source.number();
    const auto back = Rational::parse(a.text());
    ASSERT_TRUE(back.has_value()) << a.text();
    ASSERT_EQ(*back, a);
    ASSERT_EQ(back->is_small(), a.is_small());
  }
}

TEST(Rational, decimal_texts_are_read_exactly) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"-1.25e-3", "-1/800"}, {".5", "1/2"},         {"5.", "5"},      {"1e3", "1000"},
      {"1E+3", "1000"},       {"-0", "0"},           {"-0.0", "0"},    {"0/7", "0"},
      {"10/4", "5/2"},        {"007/014", "1/2"},    {"0e10000", "0"}, {"1e-2", "1/100"},
      {"12.50e1", "125"},     {"1e0000000001", "10"}};
  for (const auto& [text, expected] : cases) {
    const auto number = Rational::parse(text);
    ASSERT_TRUE(number.has_value()) << text;
    EXPECT_EQ(number->text(), expected) << text;
  }
  EXPECT_EQ(Rational::parse("1e10000")->text(), "1" + std::string(10'000, '0'));
  EXPECT_EQ(Rational::parse("1e-10000")->text(), "1/1" + std::string(10'000, '0'));
}

TEST(Rational, other_texts_are_refused) {
  for (const char* text : {"",
                           "-",
                           "+1",
                           " 1",
                           "1 ",
                           "--1",
                           "1/0",
                           "1/-2",
                           "1/",
                           "/2",
                           "1/2/3",
                           "1/2.0",
                           "1.5/2",
                           ".",
                           "-.",
                           "e5",
                           ".e5",
                           "1e",
                           "1e+",
                           "1e-",
                           "1e10001",
                           "1e-10001",
                           "1e99999999999999999999",
                           "1.2.3",
                           "0x10",
                           "nan",
                           "inf",
                           "1,5",
                           "1/00"}) {
    EXPECT_FALSE(Rational::parse(text).has_value()) << text;
  }
  EXPECT_FALSE(Rational::parse(std::string("1\0", 2)).has_value());
  const std::string million = "1" + std::string(1'000'000, '0');
  EXPECT_EQ(Rational::parse("0" + million)->text(), million);
}

void expect_roundings_of(const Rational& number) {
  Oracle oracle(number);
  ASSERT_EQ(number.nearest_double(), oracle.rounded(MPFR_RNDN)) << number.text();
  ASSERT_EQ(number.lower_double(), oracle.rounded(MPFR_RNDD)) << number.text();
  ASSERT_EQ(number.upper_double(), oracle.rounded(MPFR_RNDU)) << number.text();
  const double rounded = number.lower_double();
  ASSERT_EQ(number.is_double(), rounded == number.upper_double() && std::isfinite(rounded)) << number.text();
}

TEST(Rational, roundings_agree_with_mpfr) {
  NumberSource source;
  for (int round = 0; round < rounds(10'000); ++round) expect_roundings_of(source.number());
  for (int round = 0; round < rounds(5000); ++round) {
    const double value = source.any_double();
    const Rational exact(value);
    ASSERT_TRUE(exact.is_double());
    ASSERT_EQ(exact.nearest_double(), value);
    const Rational next(std::nextafter(value, kLargest));
    const Rational middle = (exact + next) / 2;
    const Rational crumb = Rational(1) / *Rational::parse("1e400");
    expect_roundings_of(middle);
    expect_roundings_of(middle + crumb);
    expect_roundings_of(middle - crumb);
    expect_roundings_of(exact + crumb);
    expect_roundings_of(exact - crumb);
  }
}

TEST(Rational, roundings_hold_at_the_ends_of_the_range_of_doubles) {
  const Rational largest(kLargest);
  const Rational half_step = Rational(0x1p970);
  EXPECT_EQ((largest + half_step).nearest_double(), kInfinity);
  EXPECT_EQ((largest + half_step).lower_double(), kLargest);
  EXPECT_EQ((largest + half_step).upper_double(), kInfinity);
  EXPECT_EQ((largest + half_step - Rational(1)).nearest_double(), kLargest);
  EXPECT_FALSE((largest + half_step).is_double());
  EXPECT_FALSE((largest + half_step + half_step).is_double());
  EXPECT_EQ((-largest - half_step).nearest_double(), -kInfinity);
  EXPECT_EQ((-largest - half_step).lower_double(), -kInfinity);
  EXPECT_EQ((-largest - half_step).upper_double(), -kLargest);
  const Rational tiniest(kTiniest);
  EXPECT_TRUE(tiniest.is_double());
  EXPECT_FALSE((tiniest / 2).is_double());
  EXPECT_EQ((tiniest / 2).nearest_double(), 0);
  EXPECT_EQ((tiniest * Rational(3, 2)).nearest_double(), 2 * kTiniest);
  EXPECT_EQ((tiniest * Rational(2, 3)).nearest_double(), kTiniest);
  EXPECT_EQ((tiniest / 2).upper_double(), kTiniest);
  EXPECT_EQ((tiniest / 2).lower_double(), 0);
  EXPECT_EQ(Rational::parse("1e-10000")->upper_double(), kTiniest);
  EXPECT_EQ(Rational::parse("-1e-10000")->lower_double(), -kTiniest);
  EXPECT_EQ(Rational::parse("1e10000")->nearest_double(), kInfinity);
  EXPECT_EQ(Rational::parse("1e10000")->lower_double(), kLargest);
}

TEST(Rational, heap_numbers_are_counted_and_small_ones_are_not) {
  reset_exact_counters();
  const Rational small = Rational(kHighest - 1) + Rational(1) - Rational(1, 3) * Rational(3);
  EXPECT_EQ(exact_counters().heap_rationals, 0U);
  EXPECT_TRUE(small.is_small());
  const Rational large = small + Rational(2);
  EXPECT_EQ(exact_counters().heap_rationals, 1U);
  EXPECT_FALSE(large.is_small());
  EXPECT_TRUE((large - Rational(1)).is_small());
  EXPECT_EQ(exact_counters().heap_rationals, 1U);
}

}  // namespace
}  // namespace algebra3d
