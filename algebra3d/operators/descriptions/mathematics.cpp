// sqrt, exp, ln, log, logB, pow, trigonometry in radians and its inverses, pi and e, from degrees to radians and back.
#include <array>

#include "algebra3d/kernel/exact/elementary.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

// The description of a function of a number, apart from its name.
struct NumberFunction {
  const char* name;
  const char* doc;
  const char* detail;
  const char* argument;  // of the example
  const char* result;
};

// Every operator here takes reals, and ints for them.
void add_function(OperatorGroup& group, const NumberFunction& row, Overload function) {
  const std::string name = row.name;
  group.add({
      .name = name,
      .syntax = name + "(_)",
      .doc = row.doc,
      .detail = row.detail,
      .exactness = Exactness::rounded_once,
      .overloads = {std::move(function)},
      .examples = {{{row.argument}, row.result}, {{"(real undefined)"}, "undefined"}},
      .errors = {{{"TRUE"}, name + ": expected (real), got (bool)"}},
  });
}

void register_powers(OperatorGroup& group) {
  add_function(group,
               {"sqrt", "The square root of a number.", "Undefined for a negative number.", "2", "1.4142135623730951"},
               overload<&square_root>("x"));
  add_function(group,
               {"exp", "e raised to this exponent.", "Undefined beyond the range of reals.", "1", "2.718281828459045"},
               overload<&exponential>("x"));
  constexpr const char* kLogarithm =
      "Undefined for a number that is not positive. `ln` and `log` are the same operator; see `logB` for other bases.";
  for (const char* name : {"ln", "log"})
    add_function(group, {name, "The natural logarithm of a number.", kLogarithm, "10", "2.302585092994046"},
                 overload<&natural_logarithm>("x"));
  group.add({
      .name = "logB",
      .host_name = "log_to_base",
      .syntax = "logB(_, _)",
      .doc = "The logarithm of a number to a base.",
      .detail = "Undefined for a number or base that is not positive, and for the base 1.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&logarithm>("x", "base")},
      .examples = {{{"1024", "2"}, "10.0"}, {{"1000", "10"}, "3.0"}, {{"2", "(real undefined)"}, "undefined"}},
      .errors = {{{"2"}, "logB: expected (real real), got (int)"}},
  });
  group.add({
      .name = "pow",
      .syntax = "pow(_, _)",
      .doc = "A number, the base, raised to an exponent; always a real.",
      .detail =
          "Undefined for a negative base and an exponent that is not an integer, for 0 and a negative exponent, and "
          "beyond the range of reals.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&power>("base", "exponent")},
      .examples = {{{"2", "10"}, "1024.0"},
                   {{"2", "0.5"}, "1.4142135623730951"},
                   {{"-8", "(/ 1 3)"}, "undefined"},
                   {{"2", "(real undefined)"}, "undefined"}},
      .errors = {{{"2"}, "pow: expected (real real), got (int)"}},
  });
}

void register_trigonometry(OperatorGroup& group) {
  constexpr const char* kRadians = "The angle is in radians; see `deg2rad`.";
  add_function(group, {"sin", "The sine of an angle.", kRadians, "1", "0.8414709848078965"}, overload<&sine>("angle"));
  add_function(group, {"cos", "The cosine of an angle.", kRadians, "1", "0.5403023058681398"},
               overload<&cosine>("angle"));
  add_function(group, {"tan", "The tangent of an angle.", kRadians, "1", "1.5574077246549023"},
               overload<&tangent>("angle"));
  const auto inverses = [&](const std::array<NumberFunction, 2>& names, const Overload& function) {
    for (const NumberFunction& row : names) add_function(group, row, function);
  };
  constexpr const char* kArcSine =
      "From -pi/2 to pi/2. Undefined for a number below -1 or above 1. `arcsin` and `asin` are the same operator.";
  constexpr const char* kArcCosine =
      "From 0 to pi. Undefined for a number below -1 or above 1. `arccos` and `acos` are the same operator.";
  constexpr const char* kArcTangent = "From -pi/2 to pi/2. `arctan` and `atan` are the same operator.";
  constexpr const char* kSineDoc = "The angle in radians with this sine.";
  constexpr const char* kCosineDoc = "The angle in radians with this cosine.";
  constexpr const char* kTangentDoc = "The angle in radians with this tangent.";
  inverses({NumberFunction{"arcsin", kSineDoc, kArcSine, "1", "1.5707963267948966"},
            NumberFunction{"asin", kSineDoc, kArcSine, "0.5", "0.5235987755982989"}},
           overload<&arc_sine>("x"));
  inverses({NumberFunction{"arccos", kCosineDoc, kArcCosine, "-1", "3.141592653589793"},
            NumberFunction{"acos", kCosineDoc, kArcCosine, "0.5", "1.0471975511965979"}},
           overload<&arc_cosine>("x"));
  inverses({NumberFunction{"arctan", kTangentDoc, kArcTangent, "1", "0.7853981633974483"},
            NumberFunction{"atan", kTangentDoc, kArcTangent, "-1", "-0.7853981633974483"}},
           overload<&arc_tangent>("x"));
  for (const std::string name : {"arctan2", "atan2"})
    group.add({
        .name = name,
        .syntax = name + "(_, _)",
        .doc = "The angle in radians of the direction (x, y), written arctan2(y, x).",
        .detail = "From -pi to pi. `arctan2` and `atan2` are the same operator.",
        .exactness = Exactness::rounded_once,
        .overloads = {overload<&arc_tangent_of_quotient>("y", "x")},
        .examples = {{{"1", "-1"}, "2.356194490192345"}, {{"0", "(real undefined)"}, "undefined"}},
        .errors = {{{"1"}, name + ": expected (real real), got (int)"}},
    });
}

void register_angles(OperatorGroup& group) {
  add_function(group, {"deg2rad", "Converts an angle from degrees to radians.", "", "180", "3.141592653589793"},
               overload<&degrees_to_radians>("degrees"));
  add_function(group, {"rad2deg", "Converts an angle from radians to degrees.", "", "1", "57.29577951308232"},
               overload<&radians_to_degrees>("radians"));
  group.add({
      .name = "const_pi",
      .host_name = "pi",
      .syntax = "const_pi()",
      .doc = "The number pi.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&circle_constant>()},
      .examples = {{{}, "3.141592653589793"}},
      .errors = {{{"1"}, "const_pi: expected (), got (int)"}},
  });
  group.add({
      .name = "const_e",
      .host_name = "e",
      .syntax = "const_e()",
      .doc = "The number e, the base of natural logarithms.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&natural_constant>()},
      .examples = {{{}, "2.718281828459045"}},
      .errors = {{{"1"}, "const_e: expected (), got (int)"}},
  });
}

}  // namespace

void register_mathematics(OperatorGroup& group) {
  register_powers(group);
  register_trigonometry(group);
  register_angles(group);
}

}  // namespace algebra3d
