// abs, floor, ceil, round, int2real, real2int, int2bool, bool2int, and numbers as text: num2string, str2int, str2real,
// tostring, totext.
#include <cmath>
#include <limits>

#include "algebra3d/kernel/exact/elementary.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "base/number_text.h"

namespace algebra3d {
namespace {

Maybe<std::int64_t> size_of_int(std::int64_t x) {
  if (x == std::numeric_limits<std::int64_t>::min())
    return Undefined{"the result 9223372036854775808 is beyond the range of ints"};
  return std::abs(x);
}
double size_of_real(double x) {
  return std::abs(x);
}
// Adding zero leaves no -0.0.
double floor_of_real(double x) {
  return std::floor(x) + 0.0;
}
double ceiling_of_real(double x) {
  return std::ceil(x) + 0.0;
}
Maybe<double> rounded_to_integer(double x) {
  return rounded_to_digits(x, 0);
}

double real_of_int(std::int64_t x) {
  return static_cast<double>(x);
}
Maybe<std::int64_t> int_of_real(double x) {
  constexpr double kBeyond = 0x1p63;
  if (x < -kBeyond || x >= kBeyond) return Undefined{real_text(x) + " is beyond the range of ints"};
  return static_cast<std::int64_t>(x);
}
bool bool_of_int(std::int64_t x) {
  return x != 0;
}
std::int64_t int_of_bool(bool x) {
  return x ? 1 : 0;
}

std::string string_of_int(std::int64_t x) {
  return std::to_string(x);
}
std::string string_of_real(double x) {
  return real_text(x);
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}
Undefined no_number(const Text& text, std::string_view expected) {
  return Undefined{fmt::format("expected {}, got {}", expected, NestedList::text(text.content).print_short())};
}
Maybe<double> real_of_text(const Text& text) {
  if (const auto number = parse_real(without_blanks(text.content))) return *number;
  return no_number(text, "a number within the range of reals");
}
Maybe<std::int64_t> int_of_text(const Text& text) {
  if (const auto number = parse_int(without_blanks(text.content))) return *number;
  return no_number(text, "an integer between -9223372036854775808 and 9223372036854775807");
}
std::string string_of_bool(bool x) {
  return x ? "TRUE" : "FALSE";
}
std::string string_of_text(const Text& text) {
  return text.content;
}
Text text_of_string(const std::string& string) {
  return {string};
}

void register_rounded(OperatorGroup& group) {
  group.add({
      .name = "abs",
      .syntax = "abs(_)",
      .doc = "The absolute value of a number.",
      .detail = "Undefined for the smallest int.",
      .exactness = Exactness::exact,
      .overloads = {overload<&size_of_int>("x"), overload<&size_of_real>("x")},
      .examples = {{{"-4"}, "4"}, {{"-3.1"}, "3.1"}, {{"(int undefined)"}, "undefined"}},
      .errors = {{{"TRUE"}, "abs: expected (int) or (real), got (bool)"}},
  });
  group.add({
      .name = "floor",
      .syntax = "floor(_)",
      .doc = "The largest integer that is not greater than a number, as a real.",
      .detail = "`real2int` converts it to an int.",
      .exactness = Exactness::exact,
      .overloads = {overload<&floor_of_real>("x")},
      .examples = {{{"-1.2"}, "-2.0"}, {{"(real undefined)"}, "undefined"}},
      .errors = {{{"TRUE"}, "floor: expected (real), got (bool)"}},
  });
  group.add({
      .name = "ceil",
      .syntax = "ceil(_)",
      .doc = "The smallest integer that is not less than a number, as a real.",
      .detail = "`real2int` converts it to an int.",
      .exactness = Exactness::exact,
      .overloads = {overload<&ceiling_of_real>("x")},
      .examples = {{{"-1.2"}, "-1.0"}, {{"(real undefined)"}, "undefined"}},
      .errors = {{{"TRUE"}, "ceil: expected (real), got (bool)"}},
  });
  group.add({
      .name = "round",
      .syntax = "round(_ ...)",
      .doc = "The nearest number with the given number of digits after the decimal point: by default 0; negative for "
             "digits before the point.",
      .detail =
          "Ties are rounded away from zero. The exact value of the real is rounded: 2.675 is slightly less than it "
          "looks, and rounds to 2.67.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&rounded_to_integer>("x"), overload<&rounded_to_digits>("x", "digits")},
      .examples = {{{"10.123", "2"}, "10.12"},
                   {{"4321.123", "-2"}, "4300.0"},
                   {{"2.5"}, "3.0"},
                   {{"2.5", "(int undefined)"}, "undefined"}},
      .errors = {{{"1.5", "0.5"}, "round: expected (real) or (real int), got (real real)"}},
  });
}

void register_number_types(OperatorGroup& group) {
  group.add({
      .name = "int2real",
      .syntax = "int2real(_)",
      .doc = "The real nearest to an int.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&real_of_int>("x")},
      .examples = {{{"-2"}, "-2.0"}, {{"(int undefined)"}, "undefined"}},
      .errors = {{{"1.5"}, "int2real: expected (int), got (real)"}},
  });
  group.add({
      .name = "real2int",
      .syntax = "real2int(_)",
      .doc = "A real without its decimal places, as an int.",
      .detail = "Undefined beyond the range of ints. See `round`, `floor` and `ceil` for other roundings.",
      .exactness = Exactness::exact,
      .overloads = {overload<&int_of_real>("x")},
      .examples = {{{"-1.2"}, "-1"}, {{"1e19"}, "undefined"}, {{"(real undefined)"}, "undefined"}},
      .errors = {{{"TRUE"}, "real2int: expected (real), got (bool)"}},
  });
  group.add({
      .name = "int2bool",
      .syntax = "int2bool(_)",
      .doc = "FALSE for 0, TRUE for every other int.",
      .exactness = Exactness::exact,
      .overloads = {overload<&bool_of_int>("x")},
      .examples = {{{"-5"}, "TRUE"}, {{"0"}, "FALSE"}, {{"(int undefined)"}, "undefined"}},
      .errors = {{{"1.5"}, "int2bool: expected (int), got (real)"}},
  });
  group.add({
      .name = "bool2int",
      .syntax = "bool2int(_)",
      .doc = "1 for TRUE, 0 for FALSE.",
      .exactness = Exactness::exact,
      .overloads = {overload<&int_of_bool>("x")},
      .examples = {{{"TRUE"}, "1"}, {{"(bool undefined)"}, "undefined"}},
      .errors = {{{"1"}, "bool2int: expected (bool), got (int)"}},
  });
}

void register_number_texts(OperatorGroup& group) {
  group.add({
      .name = "num2string",
      .syntax = "num2string(_)",
      .doc = "A number as a string, as it prints; `str2int` and `str2real` read it back.",
      .exactness = Exactness::exact,
      .overloads = {overload<&string_of_int>("x"), overload<&string_of_real>("x")},
      .examples = {{{"-684"}, R"("-684")"}, {{"-684.25"}, R"("-684.25")"}, {{"(int undefined)"}, "undefined"}},
      .errors = {{{"TRUE"}, "num2string: expected (int) or (real), got (bool)"}},
  });
  group.add({
      .name = "str2real",
      .syntax = "str2real(_)",
      .doc = "Converts a string or text with a decimal number to the nearest real.",
      .detail = "Surrounding white space is ignored. Undefined, with the reason, for other texts.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&real_of_text>("text")},
      .examples = {{{R"("2.5e1")"}, "25.0"},
                   {{"' 7 '"}, "7.0"},
                   {{R"("1,5")"}, "undefined"},
                   {{"(string undefined)"}, "undefined"}},
      .errors = {{{"1"}, "str2real: expected (text), got (int)"}},
  });
  group.add({
      .name = "str2int",
      .syntax = "str2int(_)",
      .doc = "Converts a string or text to an int.",
      .detail =
          "Surrounding white space is ignored. Undefined, with the reason, for other texts and beyond the range of "
          "ints.",
      .exactness = Exactness::exact,
      .overloads = {overload<&int_of_text>("text")},
      .examples = {{{R"("-12")"}, "-12"}, {{"'2.5'"}, "undefined"}, {{"(text undefined)"}, "undefined"}},
      .errors = {{{"1"}, "str2int: expected (text), got (int)"}},
  });
  group.add({
      .name = "tostring",
      .host_name = "to_string",
      .syntax = "tostring(_)",
      .doc = "A text, a number or a truth value as a string.",
      .detail = "Numbers and truth values are written as they print. Where a string is expected, a text is accepted "
                "without conversion.",
      .exactness = Exactness::exact,
      .overloads = {overload<&string_of_text>("text"), overload<&string_of_int>("x"), overload<&string_of_real>("x"),
                    overload<&string_of_bool>("x")},
      .examples = {{{"'gear'"}, R"("gear")"}, {{"(/ 1 4)"}, R"("0.25")"}, {{"(text undefined)"}, "undefined"}},
      .errors = {{{"1", "2"}, "tostring: expected (text), (int), (real) or (bool), got (int int)"}},
  });
  group.add({
      .name = "totext",
      .host_name = "to_text",
      .syntax = "totext(_)",
      .doc = "A string as a text.",
      .detail = "Where a text is expected, a string is accepted without conversion.",
      .exactness = Exactness::exact,
      .overloads = {overload<&text_of_string>("string")},
      .examples = {{{R"("gear")"}, "'gear'"}, {{"(string undefined)"}, "undefined"}},
      .errors = {{{"1"}, "totext: expected (string), got (int)"}},
  });
}

}  // namespace

void register_numbers(OperatorGroup& group) {
  register_rounded(group);
  register_number_types(group);
  register_number_texts(group);
}

}  // namespace algebra3d
