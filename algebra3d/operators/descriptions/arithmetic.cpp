// + - * / div mod on int and real, and those of them that exist for texts, times and vectors.
#include <cmath>
#include <cstdint>
#include <limits>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/time.h"

namespace algebra3d {
namespace {

Undefined beyond_ints(const Rational& result) {
  return Undefined{fmt::format("the result {} is beyond the range of ints", result.text())};
}

Maybe<std::int64_t> add_ints(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (__builtin_add_overflow(a, b, &sum)) return beyond_ints(Rational(a) + Rational(b));
  return sum;
}
Maybe<std::int64_t> subtract_ints(std::int64_t a, std::int64_t b) {
  std::int64_t difference = 0;
  if (__builtin_sub_overflow(a, b, &difference)) return beyond_ints(Rational(a) - Rational(b));
  return difference;
}
Maybe<std::int64_t> multiply_ints(std::int64_t a, std::int64_t b) {
  std::int64_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) return beyond_ints(Rational(a) * Rational(b));
  return product;
}
Maybe<std::int64_t> negate_int(std::int64_t a) {
  return subtract_ints(0, a);
}
double negate(double a) {
  return -a;
}
Maybe<Duration> negate_duration(const Duration& duration) {
  return Duration::make(-duration.milliseconds);
}
double add(double a, double b) {
  return a + b;
}
double subtract(double a, double b) {
  return a - b;
}
double multiply(double a, double b) {
  return a * b;
}
std::string concatenate(const std::string& a, const std::string& b) {
  return a + b;
}
Text concatenate_texts(const Text& a, const Text& b) {
  return {a.content + b.content};
}

Maybe<Instant> instant_later(const Instant& instant, const Duration& by) {
  return Instant::make(instant.milliseconds + by.milliseconds);
}
Maybe<Instant> instant_earlier(const Instant& instant, const Duration& by) {
  return Instant::make(instant.milliseconds - by.milliseconds);
}
Maybe<Duration> time_between(const Instant& end, const Instant& start) {
  return Duration::make(end.milliseconds - start.milliseconds);
}
Maybe<Duration> add_durations(const Duration& a, const Duration& b) {
  return Duration::make(a.milliseconds + b.milliseconds);
}
Maybe<Duration> subtract_durations(const Duration& a, const Duration& b) {
  return Duration::make(a.milliseconds - b.milliseconds);
}
Maybe<Duration> multiply_duration(const Duration& duration, double factor) {
  return Duration::rounded(Rational(duration.milliseconds) * Rational(factor));
}

Maybe<Vector3d> add_vectors(const Vector3d& v, const Vector3d& w) {
  return vector_of(v.components.rational() + w.components.rational());
}
Maybe<Vector3d> subtract_vectors(const Vector3d& v, const Vector3d& w) {
  return vector_of(v.components.rational() - w.components.rational());
}

Maybe<double> divide(double a, double b) {
  if (b == 0) return Undefined{"division by zero"};
  return a / b;
}

// As in C and in SECONDO: div rounds towards zero, and mod has the sign of the first operand.
Maybe<std::int64_t> divide_ints(std::int64_t a, std::int64_t b) {
  if (b == 0) return Undefined{"division by zero"};
  // The one quotient that is not an int; the processor would trap.
  if (b == -1) return subtract_ints(0, a);
  return a / b;
}

Maybe<std::int64_t> modulo(std::int64_t a, std::int64_t b) {
  if (b == 0) return Undefined{"division by zero"};
  return b == -1 ? 0 : a % b;
}

}  // namespace

void register_arithmetic(OperatorGroup& group) {
  group.add({
      .name = "+",
      .host_name = "plus",
      .syntax = "_ + _",
      .doc = "The sum of two numbers, durations or vectors, two strings or texts one after the other, or the instant "
             "after "
             "a time.",
      .detail = "Undefined if an int is beyond the range of ints, an instant outside of the years 1 to 9999, or if "
                "the days of a duration do not fit 32 bits. An int with a real is converted to the nearest real.",
      .exactness = Exactness::rounded_once,
      .overloads = {symmetric(overload<&add_ints>("a", "b")), symmetric(overload<&add>("a", "b")),
                    overload<&concatenate>("a", "b"), overload<&concatenate_texts>("a", "b"),
                    overload<&instant_later>("instant", "duration"), symmetric(overload<&add_durations>("a", "b")),
                    symmetric(overload<&add_vectors>("v", "w"))},
      .examples = {{{"1", "2"}, "3"},
                   {{"1", "0.5"}, "1.5"},
                   {{R"("ab")", R"("c")"}, R"("abc")"},
                   {{"'ab'", "'c'"}, "'abc'"},
                   {{"(theInstant 2012 2 28)", "(create_duration 1.5)"}, R"("2012-02-29-12:00")"},
                   {{"(create_duration 1.5)", "(create_duration 0.75)"}, "(2 21600000)"},
                   {{"(vector3d (1/3 0 1))", "(vector3d (1/3 2 0))"}, "(2/3 2.0 1.0)"},
                   {{"9223372036854775807", "1"}, "undefined"},
                   {{"1", "(int undefined)"}, "undefined"}},
      .errors = {{{"1", "TRUE"},
                  "+: expected (int int), (real real), (string string), (text text), (instant duration), (duration "
                  "duration) or (vector3d vector3d), got (int bool)"}},
  });
  group.add({
      .name = "-",
      .host_name = "minus",
      .syntax = "_ - _",
      .doc = "The difference of two numbers, durations or vectors, the time between two instants, or the instant a "
             "time before; "
             "`-x` is a number or duration with the other sign.",
      .detail = "Undefined where a sum is. `-x` binds looser than postfix operators and tighter than all others.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&negate_int>("a"), overload<&negate>("a"), overload<&negate_duration>("a"),
                    overload<&subtract_ints>("a", "b"), overload<&subtract>("a", "b"),
                    overload<&time_between>("end", "start"), overload<&instant_earlier>("instant", "duration"),
                    overload<&subtract_durations>("a", "b"), overload<&subtract_vectors>("v", "w")},
      .examples = {{{"(- 10 4)", "3"}, "3"},
                   {{"1.5", "1"}, "0.5"},
                   {{"(theInstant 2013)", "(theInstant 2012)"}, "(366 0)"},
                   {{"(theInstant 2012)", "(create_duration 0.25)"}, R"("2011-12-31-18:00")"},
                   {{"(create_duration 1)", "(create_duration 1.5)"}, "(-1 43200000)"},
                   {{"(+ 2 3)"}, "-5"},
                   {{"(vector3d (1/3 0 1))", "(vector3d (1/3 2 0))"}, "(0.0 -2.0 1.0)"},
                   {{"(create_duration 1.5)"}, "(-2 43200000)"},
                   {{"1", "(real undefined)"}, "undefined"}},
      .errors = {{{"1", R"("a")"}, "(instant duration), (duration duration) or 1 more, got (int string)"}},
  });
  group.add({
      .name = "*",
      .host_name = "times",
      .syntax = "_ * _",
      .doc = "The product of two numbers, or of a duration and a number.",
      .detail =
          "An int result beyond the range of ints is undefined. A duration is rounded to the nearest millisecond; "
          "it is undefined if its days do not fit 32 bits.",
      .exactness = Exactness::rounded_once,
      .overloads = {symmetric(overload<&multiply_ints>("a", "b")), symmetric(overload<&multiply>("a", "b")),
                    overload<&multiply_duration>("duration", "factor")},
      .examples = {{{"2", "3"}, "7", "(+ _ 1)"},
                   {{"0.5", "4"}, "2.0"},
                   {{"(create_duration 2)", "0.75"}, "(1 43200000)"},
                   {{"65536", "65536"}, "4294967296"},
                   {{"4294967296", "4294967296"}, "undefined"},
                   {{"2", "(int undefined)"}, "undefined"}},
      .errors = {{{"1", R"("a")"}, "*: expected (int int), (real real) or (duration real), got (int string)"}},
  });
  group.add({
      .name = "/",
      .host_name = "divide",
      .syntax = "_ / _",
      .doc = "The quotient of two numbers, always a real.",
      .detail = "Division by zero is undefined.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&divide>("a", "b")},
      .examples = {{{"1", "4"}, "0.25"}, {{"1", "0"}, "undefined"}, {{"(real undefined)", "2"}, "undefined"}},
      .errors = {{{"1", R"("a")"}, "/: expected (real real), got (int string)"}},
  });
  group.add({
      .name = "div",
      .host_name = "integer_quotient",
      .syntax = "_ div _",
      .doc = "The integer part of a quotient of ints, rounded towards zero.",
      .detail = "Undefined: division by zero, and a quotient of 2^63.",
      .exactness = Exactness::exact,
      .overloads = {overload<&divide_ints>("a", "b")},
      .examples =
          {{{"7", "2"}, "3"}, {{"-7", "2"}, "-3"}, {{"7", "0"}, "undefined"}, {{"(int undefined)", "2"}, "undefined"}},
      .errors = {{{"7.5", "2"}, "div: expected (int int), got (real int)"}},
  });
  group.add({
      .name = "mod",
      .host_name = "remainder",
      .syntax = "_ mod _",
      .doc = "The remainder of `div`, with the sign of the first operand.",
      .detail = "Division by zero is undefined.",
      .exactness = Exactness::exact,
      .overloads = {overload<&modulo>("a", "b")},
      .examples =
          {{{"7", "2"}, "1"}, {{"-7", "2"}, "-1"}, {{"7", "0"}, "undefined"}, {{"(int undefined)", "2"}, "undefined"}},
      .errors = {{{"7.5", "2"}, "mod: expected (int int), got (real int)"}},
  });
}

}  // namespace algebra3d
