// instant, duration, interval. Dates are counted by an oracle that knows nothing but the lengths of the months.
#include <array>
#include <compare>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/time.h"
#include "unit/types/reading.h"

namespace algebra3d::time_tests {
namespace {

template <typename T>
Reading read(std::string_view text) {
  return reading_of(TypeOf<T>::type(), text);
}

template <typename T>
Value value_of(std::string_view text) {
  const auto reading = read<T>(text);
  EXPECT_TRUE(reading.value.ok() && reading.value->is_defined()) << text;
  return reading.value.ok() ? *reading.value : Value(TypeOf<T>::type());
}

template <typename T>
std::string printed(std::string_view text) {
  return value_of<T>(text).to_nested().print();
}

template <typename T>
void expect_error(std::string_view text, std::string_view message) {
  const auto reading = read<T>(text);
  ASSERT_FALSE(reading.value.ok()) << text;
  EXPECT_EQ(reading.value.error().code, ErrorCode::invalid_value);
  EXPECT_EQ(reading.value.error().text(), message) << text;
}

template <typename T>
void expect_undefined(std::string_view text, std::string_view reason) {
  const auto reading = read<T>(text);
  ASSERT_TRUE(reading.value.ok()) << text << ": " << reading.value.error().text();
  EXPECT_FALSE(reading.value->is_defined()) << text;
  ASSERT_EQ(reading.diagnostics.size(), 1U) << text;
  EXPECT_EQ(reading.diagnostics[0].text, reason);
}

// One day after the other, from the first of January of the year 1.
struct CountedDay {
  int year = 1, month = 1, day = 1, weekday = 1;

  bool is_leap_year() const { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }
  int month_length() const {
    constexpr std::array kLengths = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month == 2 && is_leap_year() ? 29 : kLengths[static_cast<std::size_t>(month - 1)];
  }
  void advance() {
    weekday = weekday % 7 + 1;
    if (++day <= month_length()) return;
    day = 1;
    if (++month <= 12) return;
    month = 1;
    ++year;
  }
};

TEST(time_types, every_day_of_the_calendar_is_counted_right) {
  CountedDay day;
  std::int64_t milliseconds = Instant::kFirst;
  std::int64_t right = 0;
  for (; day.year < 10000; day.advance(), milliseconds += kMillisecondsPerDay) {
    const Instant instant{milliseconds};
    const CalendarTime expected{.year = day.year, .month = day.month, .day = day.day};
    // Without the macros of each comparison, of which there would be ten million.
    if (instant.calendar() == expected && instant.weekday() == day.weekday && Instant::at(expected).is_defined() &&
        Instant::at(expected)->milliseconds == milliseconds)
      ++right;
    if (day.day == day.month_length()) {
      ASSERT_FALSE(Instant::at({.year = day.year, .month = day.month, .day = day.day + 1}).is_defined());
    }
  }
  EXPECT_EQ(milliseconds, Instant::kLast + 1);
  EXPECT_EQ(right, 730'121 + 2'921'938);
}

TEST(time_types, known_dates) {
  // Days from 2000-01-03, by the difference of Julian day numbers (2000-01-01 12:00 is 2451545).
  const std::vector<std::pair<const char*, double>> rows{{R"("2000-01-03")", 0},
                                                         {R"("1999-12-31")", -3},
                                                         {R"("1970-01-01")", 2440588 - 2451547},
                                                         {R"("1582-10-15")", 2299161 - 2451547},
                                                         {R"("1858-11-17")", 2400001 - 2451547},
                                                         {R"("2000-02-29")", 57},
                                                         {R"("2038-01-19")", 2465443 - 2451547}};
  for (const auto& [text, days] : rows) {
    EXPECT_EQ(static_cast<double>(value_of<Instant>(text).get<Instant>().milliseconds), days * kMillisecondsPerDay);
    EXPECT_TRUE(std::is_eq(compare(value_of<Instant>(text), value_of<Instant>(std::to_string(days)))));
  }
  EXPECT_EQ(value_of<Instant>(R"("2026-11-22")").get<Instant>().weekday(), 7);
  EXPECT_EQ(value_of<Instant>(R"("1969-07-20-20:17")").get<Instant>().weekday(), 7);
}

TEST(time_types, instants_print_without_what_is_zero_at_the_end) {
  const std::vector<std::pair<const char*, const char*>> rows{
      {R"("2011-07-08")", R"("2011-07-08")"},
      {R"("2011-07-08-00:00:00.000")", R"("2011-07-08")"},
      {R"("2011-07-08-14:00")", R"("2011-07-08-14:00")"},
      {R"("2011-07-08-00:05:00")", R"("2011-07-08-00:05")"},
      {R"("2011-07-08-00:00:09")", R"("2011-07-08-00:00:09")"},
      {R"("2011-07-08-14:00:00.009")", R"("2011-07-08-14:00:00.009")"},
      {R"("2011-7-8-4:5:6.7")", R"("2011-07-08-04:05:06.700")"},
      {R"("2011-07-08-04:05.25")", R"("2011-07-08-04:05:00.250")"},
      {R"("1-1-1")", R"("0001-01-01")"},
      {R"("9999-12-31-23:59:59.999")", R"("9999-12-31-23:59:59.999")"},
      {"(8 7 2011)", R"("2011-07-08")"},
      {"(8 7 2011 14 0)", R"("2011-07-08-14:00")"},
      {"(8 7 2011 14 0 9)", R"("2011-07-08-14:00:09")"},
      {"(8 7 2011 14 0 0 90)", R"("2011-07-08-14:00:00.090")"},
      {"0", R"("2000-01-03")"},
      {"-1.75", R"("2000-01-01-06:00")"},
      {"0.000000005", R"("2000-01-03")"},
      {"0.000000006", R"("2000-01-03-00:00:00.001")"},
      {"-730121", R"("0001-01-01")"},
      {"2921937.99999999", R"("9999-12-31-23:59:59.999")"},
  };
  for (const auto& [text, expected] : rows) {
    EXPECT_EQ(printed<Instant>(text), expected) << text;
    EXPECT_TRUE(std::is_eq(compare(value_of<Instant>(expected), value_of<Instant>(text)))) << text;
  }
}

TEST(time_types, days_are_rounded_to_the_nearest_millisecond) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> days(-700'000, 2'900'000);
  for (int i = 0; i < 10'000; ++i) {
    const double given = i % 2 == 0 ? days(random) : days(random) * 1e-9;
    const Instant instant = value_of<Instant>(NestedList(given).print()).get<Instant>();
    const Rational off = Rational(given) * kMillisecondsPerDay - Rational(instant.milliseconds);
    EXPECT_TRUE(off >= Rational(-1, 2) && off < Rational(1, 2)) << given;
  }
}

TEST(time_types, malformed_instants_are_errors) {
  const std::string expected =
      R"(instant: expected "YYYY-MM-DD-hh:mm:ss.mmm", days since 2000-01-03, or (day month year [hour minute [second )"
      R"([millisecond]]]), got )";
  for (const std::string text : {R"("")",
                                 R"("2011")",
                                 R"("2011-07")",
                                 R"("2011-07-08-")",
                                 R"("2011-07-08-14")",
                                 R"("2011-07-08-14:")",
                                 R"("2011-07-08-14:00:")",
                                 R"("2011-07-08-14:00:00.")",
                                 R"("2011-07-08-14:00:00.0000")",
                                 R"("2011-07-08-14:00:00.1 ")",
                                 R"(" 2011-07-08")",
                                 R"("2011/07/08")",
                                 R"("20111-07-08")",
                                 R"("-2011-07-08")",
                                 R"("2011-07-08T14:00")",
                                 "'2011-07-08'",
                                 "TRUE",
                                 "today",
                                 "()",
                                 "(2011)",
                                 "(8 7)",
                                 "(8 7 2011 14)",
                                 "(8 7 2011 14 0 0 0 0)",
                                 "(8 7 2011.0)",
                                 "((8) 7 2011)",
                                 "1/3"})
    expect_error<Instant>(text, expected + text);
}

TEST(time_types, impossible_instants_are_undefined_with_the_reason) {
  expect_undefined<Instant>(R"("2011-02-30")", "instant: 2011-02 has no day 30");
  expect_undefined<Instant>(R"("1900-02-29")", "instant: 1900-02 has no day 29");
  expect_undefined<Instant>(R"("2011-04-00")", "instant: 2011-04 has no day 0");
  expect_undefined<Instant>(R"("2011-13-01")", "instant: there is no month 13");
  expect_undefined<Instant>(R"("2011-00-01")", "instant: there is no month 0");
  expect_undefined<Instant>(R"("0000-01-01")", "instant: the year 0 is not between 1 and 9999");
  expect_undefined<Instant>("(1 1 10000)", "instant: the year 10000 is not between 1 and 9999");
  expect_undefined<Instant>("(1 1 -2147483648)", "instant: the year -2147483648 is not between 1 and 9999");
  expect_undefined<Instant>(R"("2011-07-08-25:00")", "instant: a day has no hour 25");
  expect_undefined<Instant>(R"("2011-07-08-24:00")", "instant: a day has no hour 24");
  expect_undefined<Instant>(R"("2011-07-08-14:60")", "instant: an hour has no minute 60");
  expect_undefined<Instant>(R"("2011-07-08-14:00:60")", "instant: a minute has no second 60");
  expect_undefined<Instant>("(8 7 2011 14 0 0 1000)", "instant: a second has no millisecond 1000");
  expect_undefined<Instant>("(8 7 2011 14 0 0 -1)", "instant: a second has no millisecond -1");
  for (const char* days : {"-730122", "2921938", "2147483647", "2147483648", "1e300", "-1e300"})
    expect_undefined<Instant>(days, "instant: the instant is outside of the years 1 to 9999");
}

TEST(time_types, durations_are_normalised) {
  EXPECT_EQ(printed<Duration>("(1 2)"), "(1 2)");
  EXPECT_EQ(printed<Duration>("(0 86400000)"), "(1 0)");
  EXPECT_EQ(printed<Duration>("(0 -1)"), "(-1 86399999)");
  EXPECT_EQ(printed<Duration>("(3 -2147483648)"), "(-22 12516352)");
  EXPECT_EQ(printed<Duration>("(2147483647 86399999)"), "(2147483647 86399999)");
  EXPECT_EQ(printed<Duration>("(-2147483648 0)"), "(-2147483648 0)");
  EXPECT_TRUE(std::is_eq(compare(value_of<Duration>("(1 0)"), value_of<Duration>("(2 -86400000)"))));
  for (const char* text :
       {"(2147483647 86400000)", "(-2147483648 -1)", "(9223372036854775807 0)", "(1 9223372036854775807)"})
    expect_undefined<Duration>(text, "duration: the days of the duration are not between -2147483648 and 2147483647");
  for (const std::string text : {"1", "(1)", "(1 2 3)", "(1.0 2)", "(1 TRUE)", "()"})
    expect_error<Duration>(text, "duration: expected (days milliseconds), two ints, got " + text);
}

TEST(time_types, durations_are_rounded_from_rationals) {
  EXPECT_EQ(Duration::rounded(Rational(5, 2))->milliseconds, 3);
  EXPECT_EQ(Duration::rounded(Rational(-5, 2))->milliseconds, -2);
  EXPECT_EQ(Duration::rounded(Rational(-8, 3))->milliseconds, -3);
  EXPECT_EQ(Duration::rounded(Rational(Duration::kGreatest - 1) + Rational(2, 3))->milliseconds, Duration::kGreatest);
  EXPECT_EQ(Duration::rounded(Rational(Duration::kGreatest - 7) + Rational(1, 3))->milliseconds,
            Duration::kGreatest - 7);
  EXPECT_FALSE(Duration::rounded(Rational(Duration::kGreatest) + Rational(1, 2)).is_defined());
  EXPECT_EQ(Duration::rounded(Rational(Duration::kLeast) - Rational(1, 2))->milliseconds, Duration::kLeast);
  EXPECT_FALSE(Duration::rounded(Rational(1e300)).is_defined());
}

TEST(time_types, intervals) {
  EXPECT_EQ(printed<TimeInterval>(R"(("2011-07-08" (8 7 2011 12 0) TRUE FALSE))"),
            R"(("2011-07-08" "2011-07-08-12:00" TRUE FALSE))");
  EXPECT_EQ(printed<TimeInterval>("(0 0 TRUE TRUE)"), R"(("2000-01-03" "2000-01-03" TRUE TRUE))");
  expect_undefined<TimeInterval>("(1 0.5 TRUE TRUE)",
                                 "interval: the end 2000-01-03-12:00 comes before the start 2000-01-04");
  for (const char* sides : {"TRUE FALSE", "FALSE TRUE", "FALSE FALSE"})
    expect_undefined<TimeInterval>(std::string("(0 0 ") + sides + ")",
                                   "interval: an interval of a single instant needs both sides closed");
  expect_undefined<TimeInterval>(R"(("2011-02-30" 1 TRUE TRUE))", "interval: 2011-02 has no day 30");
  expect_undefined<TimeInterval>(R"((1 "2011-01-01-25:00" TRUE TRUE))", "interval: a day has no hour 25");
  for (const std::string text : {"0", "()", "(0 1)", "(0 1 TRUE)", "(0 1 1 1)", "(0 1 TRUE FALSE TRUE)"})
    expect_error<TimeInterval>(text, "interval: expected (start end leftclosed rightclosed), got " + text);
  expect_error<TimeInterval>(R"((0 TRUE TRUE TRUE))",
                             R"(interval: expected "YYYY-MM-DD-hh:mm:ss.mmm", days since 2000-01-03, or (day month )"
                             R"(year [hour minute [second [millisecond]]]), got TRUE)");
  expect_error<TimeInterval>("(undefined 1 TRUE TRUE)",
                             R"(interval: expected "YYYY-MM-DD-hh:mm:ss.mmm", days since 2000-01-03, or (day month )"
                             R"(year [hour minute [second [millisecond]]]), got undefined)");
}

TEST(time_types, intervals_hold_what_their_sides_say) {
  const auto contains = [](const char* sides, double days) {
    const auto interval = value_of<TimeInterval>(std::string("(0 2 ") + sides + ")").get<TimeInterval>();
    return interval.contains(value_of<Instant>(std::to_string(days)).get<Instant>());
  };
  for (const char* sides : {"TRUE TRUE", "TRUE FALSE", "FALSE TRUE", "FALSE FALSE"}) {
    EXPECT_TRUE(contains(sides, 1));
    EXPECT_FALSE(contains(sides, -1) || contains(sides, 3));
    EXPECT_EQ(contains(sides, 0), std::string_view(sides).starts_with("TRUE"));
    EXPECT_EQ(contains(sides, 2), std::string_view(sides).ends_with("TRUE"));
  }
}

const std::vector<std::pair<const Type*, std::vector<const char*>>>& ascending() {
  static const std::vector<std::pair<const Type*, std::vector<const char*>>> values{
      {&TypeOf<Instant>::type(),
       {R"("0001-01-01")", R"("1999-12-31-23:59:59.999")", "0", R"("2000-01-03-00:00:00.001")", "1",
        R"("9999-12-31-23:59:59.999")"}},
      {&TypeOf<Duration>::type(),
       {"(-2147483648 0)", "(-1 0)", "(0 -1)", "(0 0)", "(0 1)", "(1 0)", "(2147483647 86399999)"}},
      {&TypeOf<TimeInterval>::type(),
       {R"((-730121 9 FALSE FALSE))", "(0 0 TRUE TRUE)", "(0 1 TRUE FALSE)", "(0 1 TRUE TRUE)", "(0 2 TRUE FALSE)",
        "(0 1 FALSE FALSE)", "(0 1 FALSE TRUE)", "(0 2 FALSE FALSE)", "(1 1 TRUE TRUE)"}}};
  return values;
}

TEST(time_types, order_equality_hash_and_prefix_agree) {
  for (const auto& [type, texts] : ascending())
    for (std::size_t i = 0; i < texts.size(); ++i)
      for (std::size_t j = 0; j < texts.size(); ++j) {
        const Value a = *reading_of(*type, texts[i]).value;
        const Value b = *reading_of(*type, texts[j]).value;
        EXPECT_EQ(compare(a, b), i <=> j) << texts[i] << " " << texts[j];
        EXPECT_EQ(hash(a) == hash(b), i == j) << texts[i] << " " << texts[j];
        if (i < j) {
          EXPECT_LE(order_prefix(a), order_prefix(b));
          EXPECT_TRUE(!type->is_whole_in_prefix(order_prefix(a)) || order_prefix(a) < order_prefix(b));
        }
        EXPECT_GT(order_prefix(a), 0U);
      }
}

TEST(time_types, text_and_bytes_read_back_equal) {
  for (const auto& [type, texts] : ascending())
    for (const char* text : texts) {
      const Value value = *reading_of(*type, text).value;
      EXPECT_TRUE(std::is_eq(compare(*reading_of(*type, value.to_nested().print()).value, value)));
      for (const Origin origin : {Origin::own_store, Origin::elsewhere}) {
        const auto decoded = decode(*type, encode(value), origin);
        ASSERT_TRUE(decoded.ok());
        EXPECT_TRUE(std::is_eq(compare(*decoded, value)));
      }
      EXPECT_GT(heap_bytes(value), 0U);
    }
}

std::string body(std::initializer_list<std::int64_t> numbers, int closed = -1) {
  std::string bytes;
  ByteWriter writer(bytes);
  for (const std::int64_t number : numbers) writer.u64(static_cast<std::uint64_t>(number));
  if (closed >= 0) writer.u8(static_cast<std::uint8_t>(closed));
  return bytes;
}

TEST(time_types, bodies_out_of_range_are_errors) {
  const auto refused = [](const Type& type, const std::string& bytes) {
    const auto decoded = type.decode(bytes, true);
    return decoded.ok() ? "" : decoded.error().text();
  };
  const Type& instant = TypeOf<Instant>::type();
  EXPECT_EQ(refused(instant, body({Instant::kFirst})), "");
  EXPECT_EQ(refused(instant, body({Instant::kLast})), "");
  for (const std::int64_t number : {Instant::kFirst - 1, Instant::kLast + 1, INT64_MIN, INT64_MAX})
    EXPECT_EQ(refused(instant, body({number})),
              "instant: byte 8 of the body: expected an instant of the years 1 to 9999");
  const Type& duration = TypeOf<Duration>::type();
  EXPECT_EQ(refused(duration, body({Duration::kLeast})), "");
  EXPECT_EQ(refused(duration, body({Duration::kGreatest})), "");
  for (const std::int64_t number : {Duration::kLeast - 1, Duration::kGreatest + 1, INT64_MIN, INT64_MAX})
    EXPECT_EQ(refused(duration, body({number})),
              "duration: byte 8 of the body: expected a duration whose days fit 32 bits");
  const Type& interval = TypeOf<TimeInterval>::type();
  EXPECT_EQ(refused(interval, body({0, 0}, 3)), "");
  EXPECT_EQ(refused(interval, body({0, 1}, 0)), "");
  EXPECT_EQ(refused(interval, body({0, 0}, 2)),
            "interval: byte 17 of the body: expected an interval that is not empty");
  EXPECT_EQ(refused(interval, body({1, 0}, 3)),
            "interval: byte 17 of the body: expected an interval that is not empty");
  EXPECT_EQ(refused(interval, body({0, 1}, 4)), "interval: byte 17 of the body: expected 0 to 3 for the closed sides");
  EXPECT_EQ(refused(interval, body({0, INT64_MAX}, 3)),
            "interval: byte 16 of the body: expected an instant of the years 1 to 9999");
  for (const Type* type : {&instant, &duration, &interval}) {
    EXPECT_NE(refused(*type, ""), "");
    EXPECT_NE(refused(*type, body({0, 0, 0})), "");
  }
}

TEST(time_types, any_change_of_the_bytes_gives_a_value_or_an_error) {
  std::mt19937 random(3);
  for (const auto& [type, texts] : ascending())
    for (const char* text : texts) {
      std::string bytes;
      type->encode(*reading_of(*type, text).value, bytes);
      for (int i = 0; i < 500; ++i) {
        std::string changed = bytes;
        changed[random() % changed.size()] = static_cast<char>(random());
        if (random() % 4 == 0) changed.resize(random() % (changed.size() + 2));
        const auto decoded = type->decode(changed, false);
        if (!decoded.ok()) continue;
        std::string again;
        type->encode(*decoded, again);
        EXPECT_EQ(again, changed);
      }
    }
}

}  // namespace
}  // namespace algebra3d::time_tests
