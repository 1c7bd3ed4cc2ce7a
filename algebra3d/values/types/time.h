#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

// instant, duration, interval: time in whole milliseconds, in the proleptic Gregorian calendar, without time zones and
// leap seconds.

inline constexpr std::int64_t kMillisecondsPerDay = 86'400'000;

/// duration: a length of time, possibly negative. Its number of days fits 32 bits.
struct Duration {
  static constexpr std::int64_t kLeast = -(std::int64_t{1} << 31U) * kMillisecondsPerDay;
  static constexpr std::int64_t kGreatest = (std::int64_t{1} << 31U) * kMillisecondsPerDay - 1;

  std::int64_t milliseconds = 0;

  /// Undefined beyond the range.
  static Maybe<Duration> make(std::int64_t milliseconds);
  /// The sum of days and milliseconds, of any size. Undefined beyond the range.
  static Maybe<Duration> of_parts(std::int64_t days, std::int64_t milliseconds);
  /// An exact number of milliseconds, rounded to the nearest integer, halves up. Undefined beyond the range.
  static Maybe<Duration> rounded(const Rational& milliseconds);
  friend auto operator<=>(const Duration&, const Duration&) = default;
};

/// An instant as calendar date and time of day. Months and days are counted from 1.
struct CalendarTime {
  std::int64_t year = 1;
  std::int64_t month = 1;
  std::int64_t day = 1;
  std::int64_t hour = 0;
  std::int64_t minute = 0;
  std::int64_t second = 0;
  std::int64_t millisecond = 0;

  friend bool operator==(const CalendarTime&, const CalendarTime&) = default;
};

/// instant: a moment of the years 1 to 9999.
struct Instant {
  static constexpr std::int64_t kFirst = -730'121 * kMillisecondsPerDay;      ///< 0001-01-01
  static constexpr std::int64_t kLast = 2'921'938 * kMillisecondsPerDay - 1;  ///< the last millisecond of 9999

  std::int64_t milliseconds = 0;  ///< since 2000-01-03, a Monday, 00:00

  /// Undefined beyond the range.
  static Maybe<Instant> make(std::int64_t milliseconds);
  /// Undefined, with the reason, if there is no such date or time of day.
  static Maybe<Instant> at(const CalendarTime& time);
  CalendarTime calendar() const;
  int weekday() const;  ///< 1 for Monday to 7 for Sunday
  friend auto operator<=>(const Instant&, const Instant&) = default;
};

/// interval: the instants from `start` to `end`; each end is included if its side is closed. Never empty.
struct TimeInterval {
  Instant start;
  Instant end;
  bool left_closed = true;
  bool right_closed = true;

  /// Undefined if it would be empty.
  static Maybe<TimeInterval> make(Instant start, Instant end, bool left_closed, bool right_closed);
  bool contains(Instant instant) const {
    return (left_closed ? start <= instant : start < instant) && (right_closed ? instant <= end : instant < end);
  }
  /// Order by start, closed before open, then by end, open before closed.
  friend std::strong_ordering operator<=>(const TimeInterval& a, const TimeInterval& b);
  friend bool operator==(const TimeInterval&, const TimeInterval&) = default;
};

/// Reads `"YYYY-MM-DD-hh:mm:ss.mmm"`, days since 2000-01-03 or `(day month year [hour minute [second [ms]]])`. Errors:
/// invalid_value for other lists; `what` begins the message.
Result<Maybe<Instant>> instant_from_nested(const NestedList& list, std::string_view what);
/// The string, without trailing zero parts of the time: "2011-07-08", "2011-07-08-14:00", "2011-07-08-14:00:09",
/// "2011-07-08-14:00:00.009".
NestedList instant_to_nested(Instant instant);
std::string instant_text(Instant instant);

/// Reads `(start end leftclosed rightclosed)`. Errors: as above.
Result<Maybe<TimeInterval>> interval_from_nested(const NestedList& list, std::string_view what);
NestedList interval_to_nested(const TimeInterval& interval);
std::size_t hash_of(const TimeInterval& interval);

class ByteReader;
class ByteWriter;
void write_interval(ByteWriter& writer, const TimeInterval& interval);
TimeInterval read_interval(ByteReader& reader);

template <>
struct TypeOf<Instant> {
  static const Type& type();
};
template <>
struct TypeOf<Duration> {
  static const Type& type();
};
template <>
struct TypeOf<TimeInterval> {
  static const Type& type();
};

}  // namespace algebra3d
