// and, or, not.
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

bool both(bool a, bool b) {
  return a && b;
}
bool either(bool a, bool b) {
  return a || b;
}
bool negated(bool a) {
  return !a;
}

}  // namespace

void register_logic(Registry& registry) {
  registry.add({
      .name = "and",
      .host_name = "logical_and",
      .syntax = "_ and _",
      .doc = "True if both are.",
      .detail = "If the second operand cannot be undefined, it is evaluated only if the first one is TRUE.",
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&both>("a", "b"))},
      .examples = {{{"(< 1 2)", "(= (/ 6 2) 3)"}, "TRUE"},
                   {{"TRUE", "FALSE"}, "FALSE"},
                   {{"FALSE", "(bool undefined)"}, "undefined"}},
      .errors = {{{"TRUE", "1"}, "and: expected (bool bool), got (bool int)"}},
  });
  registry.add({
      .name = "or",
      .host_name = "logical_or",
      .syntax = "_ or _",
      .doc = "True if at least one operand is TRUE.",
      .detail = "If the second operand cannot be undefined, it is evaluated only if the first one is FALSE.",
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&either>("a", "b"))},
      .examples = {{{"(> 1 2)", "(= (/ 6 2) 3)"}, "TRUE"},
                   {{"FALSE", "FALSE"}, "FALSE"},
                   {{"TRUE", "(bool undefined)"}, "undefined"}},
      .errors = {{{"TRUE", "1"}, "or: expected (bool bool), got (bool int)"}},
  });
  registry.add({
      .name = "not",
      .host_name = "logical_not",
      .syntax = "not(_)",
      .doc = "True if the argument is FALSE.",
      .exactness = Exactness::exact,
      .overloads = {overload<&negated>("a")},
      .examples = {{{"(= 1 2)"}, "TRUE"}, {{"(bool undefined)"}, "undefined"}},
      .errors = {{{"1"}, "not: expected (bool), got (int)"}},
  });
}

}  // namespace algebra3d
