// and, or, not.
#include "algebra3d/operators/all.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/types/scalars.h"

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
      .syntax = "_ and _",
      .doc = "True if both are.",
      .detail = "If the second operand cannot be undefined it is evaluated only where the first one is TRUE.",
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&both>("a", "b"))},
      .examples = {{"1 < 2 and 6 / 2 = 3", "TRUE"},
                   {"TRUE and FALSE", "FALSE"},
                   {"FALSE and [const bool value undefined]", "undefined"}},
      .errors = {{"query TRUE and 1", "and: expected (bool bool), got (bool int)"}},
  });
  registry.add({
      .name = "or",
      .syntax = "_ or _",
      .doc = "True if one of them is.",
      .detail = "If the second operand cannot be undefined it is evaluated only where the first one is FALSE.",
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&either>("a", "b"))},
      .examples = {{"1 > 2 or 6 / 2 = 3", "TRUE"},
                   {"FALSE or FALSE", "FALSE"},
                   {"TRUE or [const bool value undefined]", "undefined"}},
      .errors = {{"query TRUE or 1", "or: expected (bool bool), got (bool int)"}},
  });
  registry.add({
      .name = "not",
      .syntax = "not(_)",
      .doc = "True if the argument is FALSE.",
      .exactness = Exactness::exact,
      .overloads = {overload<&negated>("a")},
      .examples = {{"not(1 = 2)", "TRUE"}, {"not([const bool value undefined])", "undefined"}},
      .errors = {{"query not(1)", "not: expected (bool), got (int)"}},
  });
}

}  // namespace algebra3d
