// theInstant, now, year_of ... weekday_of, create_duration, duration2real, makeInterval, minimum, maximum, leftClosed,
// rightClosed. Sums and differences of times stand with those of numbers, `inside` with that of boxes.
#include <array>
#include <chrono>

#include "algebra3d/operators/all.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/time.h"

namespace algebra3d {
namespace {

// The parts from the year on; those that are not given are the first ones.
template <typename... Parts>
Maybe<Instant> instant_of_parts(Parts... parts) {
  const std::array<std::int64_t, sizeof...(Parts)> given{parts...};
  CalendarTime time;
  const std::array fields = {&time.year,   &time.month,  &time.day,        &time.hour,
                             &time.minute, &time.second, &time.millisecond};
  for (std::size_t i = 0; i < given.size(); ++i) *fields[i] = given[i];
  return Instant::at(time);
}

Maybe<Instant> current_instant() {
  using std::chrono::floor, std::chrono::milliseconds, std::chrono::system_clock;
  const auto since_1970 = floor<milliseconds>(system_clock::now()).time_since_epoch();
  const Maybe<Instant> begin = Instant::at({.year = 1970});
  return Instant::make(begin->milliseconds + since_1970.count());
}

template <std::int64_t CalendarTime::*part>
std::int64_t part_of(const Instant& instant) {
  return instant.calendar().*part;
}

std::int64_t weekday_of(const Instant& instant) {
  return instant.weekday();
}

Maybe<Duration> duration_of_days(double days) {
  return Duration::rounded(Rational(days) * kMillisecondsPerDay);
}
Maybe<Duration> duration_of_parts(std::int64_t days, std::int64_t milliseconds) {
  return Duration::of_parts(days, milliseconds);
}
double days_of(const Duration& duration) {
  return Rational(duration.milliseconds, kMillisecondsPerDay).nearest_double();
}

Maybe<TimeInterval> interval_of(const Instant& start, const Instant& end, bool left_closed, bool right_closed) {
  return TimeInterval::make(start, end, left_closed, right_closed);
}
Instant interval_start(const TimeInterval& interval) {
  return interval.start;
}
Instant interval_end(const TimeInterval& interval) {
  return interval.end;
}
bool is_left_closed(const TimeInterval& interval) {
  return interval.left_closed;
}
bool is_right_closed(const TimeInterval& interval) {
  return interval.right_closed;
}

const std::string kUndefinedInstant = "[const instant value undefined]";
const std::string kDay = R"([const interval value ("2011-07-08" "2011-07-09" TRUE FALSE)])";

void register_instants(Registry& registry) {
  using Int = std::int64_t;
  registry.add({
      .name = "theInstant",
      .syntax = "theInstant(_ ...)",
      .doc = "The instant with this year, month, day, hour, minute, second and millisecond, as many as are given.",
      .detail = "The others are the first ones: month and day 1, the rest 0. Years from 1 to 9999, in the Gregorian "
                "calendar throughout. Undefined if there is no such day or time of day.",
      .exactness = Exactness::exact,
      .overloads = {overload<&instant_of_parts<Int>>("year"), overload<&instant_of_parts<Int, Int>>("year", "month"),
                    overload<&instant_of_parts<Int, Int, Int>>("year", "month", "day"),
                    overload<&instant_of_parts<Int, Int, Int, Int>>("year", "month", "day", "hour"),
                    overload<&instant_of_parts<Int, Int, Int, Int, Int>>("year", "month", "day", "hour", "minute"),
                    overload<&instant_of_parts<Int, Int, Int, Int, Int, Int>>("year", "month", "day", "hour", "minute",
                                                                              "second"),
                    overload<&instant_of_parts<Int, Int, Int, Int, Int, Int, Int>>("year", "month", "day", "hour",
                                                                                   "minute", "second", "millisecond")},
      .examples = {{"theInstant(2011, 7, 8, 14)", R"("2011-07-08-14:00")"},
                   {"theInstant(2012)", R"("2012-01-01")"},
                   {"theInstant(2012, 7)", R"("2012-07-01")"},
                   {"theInstant(2011, 2, 29)", "undefined"},
                   {"theInstant(2011, [const int value undefined])", "undefined"}},
      .errors = {{"query theInstant(2011.5)", "theInstant: expected (int), (int int), (int int int)"}},
  });
  registry.add({
      .name = "now",
      .syntax = "now()",
      .doc = "The instant at which it is evaluated, by the computer's clock, in UTC.",
      .overloads = {overload<&current_instant>()},
      .examples = {{"now() > theInstant(2020)", "TRUE"}, {"now() - " + kUndefinedInstant, "undefined"}},
      .errors = {{"query now(1)", "now: expected (), got (int)"}},
  });
}

template <typename Row>
void register_part(Registry& registry, const Row& row, Overload part) {
  registry.add({
      .name = row.name,
      .syntax = std::string(row.name) + "(_)",
      .doc = row.doc,
      .exactness = Exactness::exact,
      .overloads = {std::move(part)},
      .examples = {{std::string(row.name) + "(theInstant(2011, 7, 8, 14, 5, 6, 7))", row.result},
                   {std::string(row.name) + "(" + kUndefinedInstant + ")", "undefined"}},
      .errors = {{std::string("query ") + row.name + "(2011)",
                  std::string(row.name) + ": expected (instant), got (int)"}},
  });
}

void register_parts(Registry& registry) {
  struct Row {
    const char* name;
    const char* doc;
    const char* result;
  };
  register_part(registry, Row{"year_of", "The year of an instant.", "2011"},
                overload<&part_of<&CalendarTime::year>>("instant"));
  register_part(registry, Row{"month_of", "The month of an instant, from 1 to 12.", "7"},
                overload<&part_of<&CalendarTime::month>>("instant"));
  register_part(registry, Row{"day_of", "The day of an instant in its month, from 1 to 31.", "8"},
                overload<&part_of<&CalendarTime::day>>("instant"));
  register_part(registry, Row{"hour_of", "The hour of an instant, from 0 to 23.", "14"},
                overload<&part_of<&CalendarTime::hour>>("instant"));
  register_part(registry, Row{"minute_of", "The minute of an instant, from 0 to 59.", "5"},
                overload<&part_of<&CalendarTime::minute>>("instant"));
  register_part(registry, Row{"second_of", "The second of an instant, from 0 to 59.", "6"},
                overload<&part_of<&CalendarTime::second>>("instant"));
  register_part(registry, Row{"millisecond_of", "The millisecond of an instant, from 0 to 999.", "7"},
                overload<&part_of<&CalendarTime::millisecond>>("instant"));
  register_part(registry,
                Row{"weekday_of", "The day of the week of an instant, from 1 for Monday to 7 for Sunday.", "5"},
                overload<&weekday_of>("instant"));
}

void register_durations(Registry& registry) {
  registry.add({
      .name = "create_duration",
      .syntax = "create_duration(_ ...)",
      .doc = "The duration of so many days, or of so many days and milliseconds.",
      .detail = "Rounded to the nearest millisecond. Undefined if the days are not between -2^31 and 2^31 - 1.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&duration_of_days>("days"), overload<&duration_of_parts>("days", "milliseconds")},
      .examples = {{"create_duration(1.5)", "(1 43200000)"},
                   {"create_duration(2, -1)", "(1 86399999)"},
                   {"create_duration(1e10)", "undefined"},
                   {"create_duration(1, [const int value undefined])", "undefined"}},
      .errors = {{"query create_duration(TRUE)", "create_duration: expected (real) or (int int), got (bool)"}},
  });
  registry.add({
      .name = "duration2real",
      .syntax = "duration2real(_)",
      .doc = "A duration in days.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&days_of>("duration")},
      .examples = {{"duration2real(create_duration(1, 43200000))", "1.5"},
                   {"duration2real(theInstant(2012) - theInstant(2013))", "-366.0"},
                   {"duration2real([const duration value undefined])", "undefined"}},
      .errors = {{"query duration2real(1)", "duration2real: expected (duration), got (int)"}},
  });
}

void register_interval_ends(Registry& registry) {
  registry.add({
      .name = "minimum",
      .syntax = "minimum(_)",
      .doc = "The start of an interval, whether it belongs to it or not.",
      .exactness = Exactness::exact,
      .overloads = {overload<&interval_start>("interval")},
      .examples = {{"minimum(" + kDay + ")", R"("2011-07-08")"},
                   {"minimum([const interval value undefined])", "undefined"}},
      .errors = {{"query minimum(1)", "minimum: expected (interval), got (int)"}},
  });
  registry.add({
      .name = "maximum",
      .syntax = "maximum(_)",
      .doc = "The end of an interval, whether it belongs to it or not.",
      .exactness = Exactness::exact,
      .overloads = {overload<&interval_end>("interval")},
      .examples = {{"maximum(" + kDay + ")", R"("2011-07-09")"},
                   {"maximum([const interval value undefined])", "undefined"}},
      .errors = {{"query maximum(1)", "maximum: expected (interval), got (int)"}},
  });
  registry.add({
      .name = "leftClosed",
      .syntax = "leftClosed(_)",
      .doc = "True if the start of an interval belongs to it.",
      .exactness = Exactness::exact,
      .overloads = {overload<&is_left_closed>("interval")},
      .examples = {{"leftClosed(" + kDay + ")", "TRUE"}, {"leftClosed([const interval value undefined])", "undefined"}},
      .errors = {{"query leftClosed(1)", "leftClosed: expected (interval), got (int)"}},
  });
  registry.add({
      .name = "rightClosed",
      .syntax = "rightClosed(_)",
      .doc = "True if the end of an interval belongs to it.",
      .exactness = Exactness::exact,
      .overloads = {overload<&is_right_closed>("interval")},
      .examples = {{"rightClosed(" + kDay + ")", "FALSE"},
                   {"rightClosed([const interval value undefined])", "undefined"}},
      .errors = {{"query rightClosed(1)", "rightClosed: expected (interval), got (int)"}},
  });
}

}  // namespace

void register_time(Registry& registry) {
  register_instants(registry);
  register_parts(registry);
  register_durations(registry);
  registry.add({
      .name = "makeInterval",
      .syntax = "makeInterval(_, _, _, _)",
      .doc = "The interval from one instant to another; the last two say whether start and end belong to it.",
      .detail = "Undefined if the end comes before the start, or if both are one instant and not both belong to it.",
      .exactness = Exactness::exact,
      .overloads = {overload<&interval_of>("start", "end", "leftclosed", "rightclosed")},
      .examples = {{"makeInterval(theInstant(2011), theInstant(2012), TRUE, FALSE)",
                    R"(("2011-01-01" "2012-01-01" TRUE FALSE))"},
                   {"makeInterval(theInstant(2012), theInstant(2011), TRUE, FALSE)", "undefined"},
                   {"makeInterval(" + kUndefinedInstant + ", theInstant(2011), TRUE, FALSE)", "undefined"}},
      .errors = {{"query makeInterval(1, 2, TRUE, TRUE)",
                  "makeInterval: expected (instant instant bool bool), got (int int bool bool)"}},
  });
  register_interval_ends(registry);
}

}  // namespace algebra3d
