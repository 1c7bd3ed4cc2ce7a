#include <array>
#include <chrono>
#include <cmath>
#include <optional>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/time.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

constexpr std::string_view kInstantNotation =
    R"("YYYY-MM-DD-hh:mm:ss.mmm", days since 2000-01-03, or (day month year [hour minute [second [millisecond]]]))";
constexpr std::string_view kOutsideOfYears = "the instant is outside of the years 1 to 9999";
constexpr std::int64_t kHour = 3'600'000;
constexpr std::int64_t kMinute = 60'000;
constexpr std::int64_t kSecond = 1'000;

constexpr std::chrono::sys_days kDayZero = std::chrono::year(2000) / 1 / 3;

/// Reads the parts of an instant from a text, from its beginning to its end.
class InstantScanner {
 public:
  explicit InstantScanner(std::string_view text) : rest_(text) {}

  bool is_at_end() const { return rest_.empty(); }
  bool take(char wanted) {
    if (rest_.empty() || rest_.front() != wanted) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// One to `most` digits.
  bool take_number(std::size_t most, std::int64_t& number) {
    const std::size_t digits = count_digits();
    if (digits == 0 || digits > most) return false;
    number = 0;
    for (const char digit : rest_.substr(0, digits)) number = number * 10 + (digit - '0');
    rest_.remove_prefix(digits);
    return true;
  }
  /// One to three decimal places of a second: ".5" are 500 milliseconds.
  bool take_milliseconds(std::int64_t& number) {
    const std::size_t digits = count_digits();
    if (!take_number(3, number)) return false;
    for (std::size_t i = digits; i < 3; ++i) number *= 10;
    return true;
  }

 private:
  std::size_t count_digits() const {
    std::size_t digits = 0;
    while (digits < rest_.size() && '0' <= rest_[digits] && rest_[digits] <= '9') ++digits;
    return digits;
  }
  std::string_view rest_;
};

std::optional<CalendarTime> calendar_from_text(std::string_view text) {
  InstantScanner scanner(text);
  CalendarTime time;
  if (!scanner.take_number(4, time.year) || !scanner.take('-') || !scanner.take_number(2, time.month) ||
      !scanner.take('-') || !scanner.take_number(2, time.day))
    return std::nullopt;
  if (scanner.is_at_end()) return time;
  if (!scanner.take('-') || !scanner.take_number(2, time.hour) || !scanner.take(':') ||
      !scanner.take_number(2, time.minute))
    return std::nullopt;
  if (scanner.take(':') && !scanner.take_number(2, time.second)) return std::nullopt;
  if (scanner.take('.') && !scanner.take_milliseconds(time.millisecond)) return std::nullopt;
  return scanner.is_at_end() ? std::optional(time) : std::nullopt;
}

std::optional<CalendarTime> calendar_from_list(const NestedList::List& parts) {
  if (parts.size() != 3 && (parts.size() < 5 || parts.size() > 7)) return std::nullopt;
  CalendarTime time;
  const std::array fields = {&time.day,    &time.month,  &time.year,       &time.hour,
                             &time.minute, &time.second, &time.millisecond};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].is_int()) return std::nullopt;
    *fields[i] = parts[i].as_int();
  }
  return time;
}

/// The number of days that an atom gives, if it is a number.
std::optional<double> days_from_nested(const NestedList& list) {
  if (list.is_int()) return static_cast<double>(list.as_int());
  if (list.is_real()) return list.as_real();
  return whole_number_from_nested(list);
}

Maybe<Instant> instant_after_days(double days) {
  if (!(std::abs(days) < 1e7)) return Undefined{std::string(kOutsideOfYears)};
  const auto after = Duration::rounded(Rational(days) * kMillisecondsPerDay);
  return Instant::make(after->milliseconds);
}

class InstantType final : public DescribedType {
 public:
  InstantType()
      : DescribedType({.name = "instant",
                       .doc = "A moment of the years 1 to 9999, in milliseconds.",
                       .notation = kInstantNotation,
                       .example = R"("2011-07-08-14:00")",
                       .kinds = {Kind::data}}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    A3D_ASSIGN(const Maybe<Instant> instant, instant_from_nested(list, name()));
    return instant ? Value::of(*instant) : undefined(instant.reason(), list, context);
  }
  NestedList to_nested(const Value& value) const override { return instant_to_nested(value.get<Instant>()); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<Instant>() <=> b.get<Instant>();
  }
  std::size_t hash(const Value& value) const override {
    return hash_word(static_cast<std::uint64_t>(value.get<Instant>().milliseconds));
  }
  std::uint64_t order_prefix(const Value& value) const override {
    return static_cast<std::uint64_t>(value.get<Instant>().milliseconds - Instant::kFirst + 1);
  }
  bool is_whole_in_prefix(std::uint64_t /*prefix*/) const override { return true; }
  std::size_t heap_bytes(const Value& /*value*/) const override { return object_bytes<Instant>(); }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter(bytes).u64(static_cast<std::uint64_t>(value.get<Instant>().milliseconds));
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const auto instant = Instant::make(static_cast<std::int64_t>(reader.u64()));
    reader.require(instant.is_defined(), "an instant of the years 1 to 9999");
    A3D_TRY(reader.finish());
    return Value::of(*instant);
  }
};

}  // namespace

Maybe<Instant> Instant::make(std::int64_t milliseconds) {
  if (milliseconds < kFirst || milliseconds > kLast) return Undefined{std::string(kOutsideOfYears)};
  return Instant{milliseconds};
}

Maybe<Instant> Instant::at(const CalendarTime& time) {
  if (time.year < 1 || time.year > 9999)
    return Undefined{fmt::format("the year {} is not between 1 and 9999", time.year)};
  if (time.month < 1 || time.month > 12) return Undefined{fmt::format("there is no month {}", time.month)};
  const std::chrono::year_month month(std::chrono::year(static_cast<int>(time.year)),
                                      std::chrono::month(static_cast<unsigned>(time.month)));
  const std::chrono::year_month_day_last last = month / std::chrono::last;
  if (time.day < 1 || time.day > static_cast<std::int64_t>(static_cast<unsigned>(last.day())))
    return Undefined{fmt::format("{:04}-{:02} has no day {}", time.year, time.month, time.day)};
  if (time.hour < 0 || time.hour > 23) return Undefined{fmt::format("a day has no hour {}", time.hour)};
  if (time.minute < 0 || time.minute > 59) return Undefined{fmt::format("an hour has no minute {}", time.minute)};
  if (time.second < 0 || time.second > 59) return Undefined{fmt::format("a minute has no second {}", time.second)};
  if (time.millisecond < 0 || time.millisecond > 999)
    return Undefined{fmt::format("a second has no millisecond {}", time.millisecond)};
  const std::chrono::sys_days day = month / std::chrono::day(static_cast<unsigned>(time.day));
  return Instant{(day - kDayZero).count() * kMillisecondsPerDay + time.hour * kHour + time.minute * kMinute +
                 time.second * kSecond + time.millisecond};
}

CalendarTime Instant::calendar() const {
  const std::int64_t since_first = milliseconds - kFirst;
  const std::int64_t of_day = since_first % kMillisecondsPerDay;
  const auto days = static_cast<int>((since_first - of_day + kFirst) / kMillisecondsPerDay);
  const std::chrono::year_month_day date(kDayZero + std::chrono::days(days));
  return {.year = static_cast<int>(date.year()),
          .month = static_cast<unsigned>(date.month()),
          .day = static_cast<unsigned>(date.day()),
          .hour = of_day / kHour,
          .minute = of_day % kHour / kMinute,
          .second = of_day % kMinute / kSecond,
          .millisecond = of_day % kSecond};
}

int Instant::weekday() const {
  // The first of January of the year 1 is a Monday, as is 2000-01-03.
  static_assert(kFirst % (7 * kMillisecondsPerDay) == 0);
  return static_cast<int>((milliseconds - kFirst) / kMillisecondsPerDay % 7) + 1;
}

Result<Maybe<Instant>> instant_from_nested(const NestedList& list, std::string_view what) {
  if (const auto days = days_from_nested(list)) return instant_after_days(*days);
  const auto time = list.is_string() ? calendar_from_text(list.as_string())
                    : list.is_list() ? calendar_from_list(list.elements())
                                     : std::nullopt;
  if (!time)
    return Error{ErrorCode::invalid_value, "{}: expected {}, got {}", what, kInstantNotation, list.print_short()};
  return Instant::at(*time);
}

std::string instant_text(Instant instant) {
  const CalendarTime time = instant.calendar();
  std::string text = fmt::format("{:04}-{:02}-{:02}", time.year, time.month, time.day);
  const bool has_seconds = time.second != 0 || time.millisecond != 0;
  if (has_seconds || time.hour != 0 || time.minute != 0) text += fmt::format("-{:02}:{:02}", time.hour, time.minute);
  if (has_seconds) text += fmt::format(":{:02}", time.second);
  if (time.millisecond != 0) text += fmt::format(".{:03}", time.millisecond);
  return text;
}

NestedList instant_to_nested(Instant instant) {
  return NestedList(instant_text(instant));
}

const Type& TypeOf<Instant>::type() {
  static const InstantType the_type;
  return the_type;
}

}  // namespace algebra3d
