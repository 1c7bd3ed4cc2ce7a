// theInstant, now, year_of ... weekday_of, create_duration, duration2real, makeInterval, minimum, maximum, leftClosed,
// rightClosed. Sums and differences of times stand with those of numbers, `inside` with that of boxes.
#include <array>
#include <chrono>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/time.h"

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

const std::string kUndefinedInstant = "(instant undefined)";
const std::string kDay = R"((interval ("2011-07-08" "2011-07-09" TRUE FALSE)))";

void register_instants(OperatorGroup& group) {
  using Int = std::int64_t;
  group.add({
      .name = "theInstant",
      .syntax = "theInstant(_ ...)",
      .doc = "The instant with the given year, month, day, hour, minute, second and millisecond; all but the year "
             "are optional.",
      .detail = "By default month and day are 1, the others 0. Years are from 1 to 9999, in the proleptic Gregorian "
                "calendar. Undefined if there is no such date or time of day.",
      .exactness = Exactness::exact,
      .overloads = {overload<&instant_of_parts<Int>>("year"), overload<&instant_of_parts<Int, Int>>("year", "month"),
                    overload<&instant_of_parts<Int, Int, Int>>("year", "month", "day"),
                    overload<&instant_of_parts<Int, Int, Int, Int>>("year", "month", "day", "hour"),
                    overload<&instant_of_parts<Int, Int, Int, Int, Int>>("year", "month", "day", "hour", "minute"),
                    overload<&instant_of_parts<Int, Int, Int, Int, Int, Int>>("year", "month", "day", "hour", "minute",
                                                                              "second"),
                    overload<&instant_of_parts<Int, Int, Int, Int, Int, Int, Int>>("year", "month", "day", "hour",
                                                                                   "minute", "second", "millisecond")},
      .examples = {{{"2011", "7", "8", "14"}, R"("2011-07-08-14:00")"},
                   {{"2012"}, R"("2012-01-01")"},
                   {{"2012", "7"}, R"("2012-07-01")"},
                   {{"2011", "2", "29"}, "undefined"},
                   {{"2011", "(int undefined)"}, "undefined"}},
      .errors = {{{"2011.5"}, "theInstant: expected (int), (int int), (int int int)"}},
  });
  group.add({
      .name = "now",
      .syntax = "now()",
      .doc = "The present instant by the computer's clock, in UTC.",
      .is_pure = false,
      .overloads = {overload<&current_instant>()},
      .examples = {{{}, "TRUE", "(> _ (theInstant 2020))"}},
      .errors = {{{"1"}, "now: expected (), got (int)"}},
  });
}

template <typename Row>
void register_part(OperatorGroup& group, const Row& row, Overload part) {
  group.add({
      .name = row.name,
      .syntax = std::string(row.name) + "(_)",
      .doc = row.doc,
      .exactness = Exactness::exact,
      .overloads = {std::move(part)},
      .examples = {{{"(theInstant 2011 7 8 14 5 6 7)"}, row.result}, {{kUndefinedInstant}, "undefined"}},
      .errors = {{{"2011"}, std::string(row.name) + ": expected (instant), got (int)"}},
  });
}

void register_parts(OperatorGroup& group) {
  struct Row {
    const char* name;
    const char* doc;
    const char* result;
  };
  register_part(group, Row{"year_of", "The year of an instant.", "2011"},
                overload<&part_of<&CalendarTime::year>>("instant"));
  register_part(group, Row{"month_of", "The month of an instant, from 1 to 12.", "7"},
                overload<&part_of<&CalendarTime::month>>("instant"));
  register_part(group, Row{"day_of", "The day of an instant in its month, from 1 to 31.", "8"},
                overload<&part_of<&CalendarTime::day>>("instant"));
  register_part(group, Row{"hour_of", "The hour of an instant, from 0 to 23.", "14"},
                overload<&part_of<&CalendarTime::hour>>("instant"));
  register_part(group, Row{"minute_of", "The minute of an instant, from 0 to 59.", "5"},
                overload<&part_of<&CalendarTime::minute>>("instant"));
  register_part(group, Row{"second_of", "The second of an instant, from 0 to 59.", "6"},
                overload<&part_of<&CalendarTime::second>>("instant"));
  register_part(group, Row{"millisecond_of", "The millisecond of an instant, from 0 to 999.", "7"},
                overload<&part_of<&CalendarTime::millisecond>>("instant"));
  register_part(group, Row{"weekday_of", "The day of the week of an instant, from 1 for Monday to 7 for Sunday.", "5"},
                overload<&weekday_of>("instant"));
}

void register_durations(OperatorGroup& group) {
  group.add({
      .name = "create_duration",
      .syntax = "create_duration(_ ...)",
      .doc = "The duration of the given days, or days and milliseconds.",
      .detail = "Rounded to the nearest millisecond. Undefined if the days are not between -2^31 and 2^31 - 1.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&duration_of_days>("days"), overload<&duration_of_parts>("days", "milliseconds")},
      .examples = {{{"1.5"}, "(1 43200000)"},
                   {{"2", "-1"}, "(1 86399999)"},
                   {{"1e10"}, "undefined"},
                   {{"1", "(int undefined)"}, "undefined"}},
      .errors = {{{"TRUE"}, "create_duration: expected (real) or (int int), got (bool)"}},
  });
  group.add({
      .name = "duration2real",
      .syntax = "duration2real(_)",
      .doc = "A duration in days.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&days_of>("duration")},
      .examples = {{{"(create_duration 1 43200000)"}, "1.5"},
                   {{"(- (theInstant 2012) (theInstant 2013))"}, "-366.0"},
                   {{"(duration undefined)"}, "undefined"}},
      .errors = {{{"1"}, "duration2real: expected (duration), got (int)"}},
  });
}

void register_interval_ends(OperatorGroup& group) {
  group.add({
      .name = "minimum",
      .syntax = "minimum(_)",
      .doc = "The start of an interval, included or not.",
      .exactness = Exactness::exact,
      .overloads = {overload<&interval_start>("interval")},
      .examples = {{{kDay}, R"("2011-07-08")"}, {{"(interval undefined)"}, "undefined"}},
      .errors = {{{"1"}, "minimum: expected (interval), got (int)"}},
  });
  group.add({
      .name = "maximum",
      .syntax = "maximum(_)",
      .doc = "The end of an interval, included or not.",
      .exactness = Exactness::exact,
      .overloads = {overload<&interval_end>("interval")},
      .examples = {{{kDay}, R"("2011-07-09")"}, {{"(interval undefined)"}, "undefined"}},
      .errors = {{{"1"}, "maximum: expected (interval), got (int)"}},
  });
  group.add({
      .name = "leftClosed",
      .syntax = "leftClosed(_)",
      .doc = "True if the start of an interval is included.",
      .exactness = Exactness::exact,
      .overloads = {overload<&is_left_closed>("interval")},
      .examples = {{{kDay}, "TRUE"}, {{"(interval undefined)"}, "undefined"}},
      .errors = {{{"1"}, "leftClosed: expected (interval), got (int)"}},
  });
  group.add({
      .name = "rightClosed",
      .syntax = "rightClosed(_)",
      .doc = "True if the end of an interval is included.",
      .exactness = Exactness::exact,
      .overloads = {overload<&is_right_closed>("interval")},
      .examples = {{{kDay}, "FALSE"}, {{"(interval undefined)"}, "undefined"}},
      .errors = {{{"1"}, "rightClosed: expected (interval), got (int)"}},
  });
}

}  // namespace

void register_time(OperatorGroup& group) {
  register_instants(group);
  register_parts(group);
  register_durations(group);
  group.add({
      .name = "makeInterval",
      .syntax = "makeInterval(_, _, _, _)",
      .doc = "The interval from one instant to another; the last two arguments say whether start and end are "
             "included.",
      .detail = "Undefined if the end comes before the start, or if both are the same instant and not both are "
                "included.",
      .exactness = Exactness::exact,
      .overloads = {overload<&interval_of>("start", "end", "leftclosed", "rightclosed")},
      .examples = {{{"(theInstant 2011)", "(theInstant 2012)", "TRUE", "FALSE"},
                    R"(("2011-01-01" "2012-01-01" TRUE FALSE))"},
                   {{"(theInstant 2012)", "(theInstant 2011)", "TRUE", "FALSE"}, "undefined"},
                   {{kUndefinedInstant, "(theInstant 2011)", "TRUE", "FALSE"}, "undefined"}},
      .errors = {{{"1", "2", "TRUE", "TRUE"},
                  "makeInterval: expected (instant instant bool bool), got (int int bool bool)"}},
  });
  register_interval_ends(group);
}

}  // namespace algebra3d
