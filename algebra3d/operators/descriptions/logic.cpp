// and, or, not.
#include <utility>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

/// `and` (decided by FALSE) or `or` (decided by TRUE): the deciding value if an operand has it, else undefined if an
/// operand is. This is the strong logic of Kleene, as in SQL.
template <bool kDecides>
Overload connective() {
  const Type& type = TypeOf<bool>::type();
  Overload overload;
  overload.parameters = {{"a", &type, true}, {"b", &type, true}};
  overload.result = &type;
  overload.never_fails = true;
  overload.function = [](std::span<const Value> operands, Context&) -> Result<Outcome> {
    for (const Value& operand : operands)
      if (operand.is_defined() && operand.get<bool>() == kDecides) return Outcome(operand);
    for (const Value& operand : operands)
      if (!operand.is_defined()) return Outcome(operand);
    return Outcome(Value::of<bool>(!kDecides));
  };
  return symmetric(std::move(overload));
}

bool negated(bool a) {
  return !a;
}

}  // namespace

void register_logic(OperatorGroup& group) {
  group.add({
      .name = "and",
      .host_name = "logical_and",
      .syntax = "_ and _",
      .doc = "True if both are.",
      .detail =
          "FALSE if an operand is FALSE, else undefined if an operand is. If the first operand is FALSE, the second "
          "one is not evaluated, unless it may be undefined and may end in an error.",
      .exactness = Exactness::exact,
      .overloads = {connective<false>()},
      .examples = {{{"(< 1 2)", "(= (/ 6 2) 3)"}, "TRUE"},
                   {{"TRUE", "FALSE"}, "FALSE"},
                   {{"FALSE", "(bool undefined)"}, "FALSE"},
                   {{"(bool undefined)", "TRUE"}, "undefined"}},
      .errors = {{{"TRUE", "1"}, "and: expected (bool bool), got (bool int)"}},
  });
  group.add({
      .name = "or",
      .host_name = "logical_or",
      .syntax = "_ or _",
      .doc = "True if at least one operand is TRUE.",
      .detail =
          "Else undefined if an operand is. If the first operand is TRUE, the second one is not evaluated, unless "
          "it may be undefined and may end in an error.",
      .exactness = Exactness::exact,
      .overloads = {connective<true>()},
      .examples = {{{"(> 1 2)", "(= (/ 6 2) 3)"}, "TRUE"},
                   {{"FALSE", "FALSE"}, "FALSE"},
                   {{"TRUE", "(bool undefined)"}, "TRUE"},
                   {{"(bool undefined)", "FALSE"}, "undefined"}},
      .errors = {{{"TRUE", "1"}, "or: expected (bool bool), got (bool int)"}},
  });
  group.add({
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
