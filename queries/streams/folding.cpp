// aggregateB, extend_aggr: a function of two values over the values of an attribute.
#include <array>

#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/changed_tuples.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

/// A function of two values of a type that gives one of it, but for conversions.
struct FoldFunction {
  Conversion first, second, result;

  static Result<FoldFunction> make(const MappingCheck& check, const TypeExpr& function, const TypeExpr& type) {
    const TypeExpr wanted = TypeExpr::map({type, type}, type);
    const auto parameters = function.is_function() ? function.function_parameters() : std::vector<TypeExpr>();
    if (parameters.size() != 2) return check.expected("a function of type " + wanted.text(), function);
    const auto first = conversion_to(parameters[0], type);
    const auto second = conversion_to(parameters[1], type);
    const auto result = conversion_to(type, function.function_result());
    if (!first || !second || !result) return check.expected("a function of type " + wanted.text(), function);
    return FoldFunction{*first, *second, *result};
  }
  Result<Value> call(const Function& function, const Value& a, const Value& b) const {
    A3D_ASSIGN(Value left, loaded_as(a, first));
    A3D_ASSIGN(Value right, loaded_as(b, second));
    const std::array<Datum, 2> both = {Datum{std::move(left)}, Datum{std::move(right)}};
    A3D_ASSIGN(const Value value, function.call_for_value(both));
    return loaded_as(value, result);
  }
};

/// Folds values pairwise, so that every value takes part in no more than log n applications, which matters when the
/// results grow, as unions of solids do. Neighbours are combined only, the earlier one first.
class BalancedFold {
 public:
  BalancedFold(const Function& function, const FoldFunction& call) : function_(function), call_(call) {}

  Status add(Value value) {
    results_.push_back({std::move(value), 0});
    while (results_.size() > 1 && results_[results_.size() - 2].level == results_.back().level) A3D_TRY(combine_last());
    return {};
  }
  /// Nothing if no value was added.
  Result<std::optional<Value>> finish() {
    while (results_.size() > 1) A3D_TRY(combine_last());
    return results_.empty() ? std::optional<Value>() : std::optional(results_.front().value);
  }

 private:
  struct Partial {
    Value value;
    int level;  // the result of 2^level values
  };

  Status combine_last() {
    Partial& left = results_[results_.size() - 2];
    A3D_ASSIGN(Value combined, call_.call(function_, left.value, results_.back().value));
    left = {std::move(combined), left.level + 1};
    results_.pop_back();
    return {};
  }

  const Function& function_;
  const FoldFunction& call_;
  std::vector<Partial> results_;  // levels descend
};

Result<BoundOperator> map_aggregate(std::span<const ArgumentType> arguments) {
  const MappingCheck check("aggregateB", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t index, check.attribute(1, tuple));
  const TypeExpr type = tuple.attributes()[index].type;
  A3D_ASSIGN(const FoldFunction call, FoldFunction::make(check, check[2].type, type));
  A3D_ASSIGN(const Conversion conversion, check.conversion(3, type));
  return BoundOperator{type, [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         BalancedFold fold(given[2].function(), call);
                         A3D_TRY(for_each_tuple(*given[0].tuples(), context, [&](const TuplePtr& next) {
                           return fold.add(next->attributes[index]);
                         }));
                         A3D_ASSIGN(const auto result, fold.finish());
                         return Datum{result ? *result : converted(given[3].value(), conversion)};
                       }};
}

/// The attributes that extend_aggr works on.
struct RunningFold {
  std::size_t attribute;
  std::optional<std::size_t> restart;  // a bool: where it is TRUE the fold begins anew
};

Result<RunningFold> running_fold(const MappingCheck& check, const TypeExpr& tuple) {
  A3D_ASSIGN(const auto attributes, check.attributes(1, tuple));
  if (attributes.empty() || attributes.size() > 2)
    return check.error("expected one attribute, or two of which the second is a bool, before the semicolon");
  RunningFold fold{attributes[0], std::nullopt};
  if (attributes.size() == 1) return fold;
  const TypeExpr& type = tuple.attributes()[attributes[1]].type;
  if (!type.is("bool")) return check.expected("a second attribute of type bool", type);
  fold.restart = attributes[1];
  return fold;
}

Result<BoundOperator> map_extend_aggr(std::span<const ArgumentType> arguments) {
  const MappingCheck check("extend_aggr", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const RunningFold fold, running_fold(check, tuple));
  const TypeExpr type = tuple.attributes()[fold.attribute].type;
  if (check[2].names.size() != 1)
    return check.error("expected one function, as in extend_aggr[A; B: fun(a: int, b: int) a + b]");
  A3D_ASSIGN(const FoldFunction call, FoldFunction::make(check, check[2].types[0], type));
  A3D_ASSIGN(const TypeExpr result, check.concatenated(tuple, TypeExpr::tuple({{check[2].names[0], type}})));
  return BoundOperator{TypeExpr::stream(result), [fold, call](std::vector<Datum> given, Context&) -> Result<Datum> {
                         const auto function = given[2].list()[0].function_ptr();
                         return changed_tuples(given[0].tuples(),
                                               [fold, call, function, so_far = std::optional<Value>()](
                                                   const TuplePtr& from, std::vector<Value>& to) mutable -> Status {
                                                 const Value& next = from->attributes[fold.attribute];
                                                 const bool begins =
                                                     !so_far ||
                                                     (fold.restart && is_true(from->attributes[*fold.restart]));
                                                 if (!begins) {
                                                   A3D_ASSIGN(so_far, call.call(*function, *so_far, next));
                                                 } else {
                                                   so_far = next;
                                                 }
                                                 to = extended_attributes(*from, 1);
                                                 to.push_back(*so_far);
                                                 return {};
                                               });
                       }};
}

}  // namespace

void register_folding(algebra3d::OperatorGroup& group) {
  const std::string runs = "[const rel(tuple([A: int, R: bool])) value ((1 FALSE) (2 FALSE) (3 TRUE) (4 FALSE))] feed ";
  group.add({
      .name = "extend_aggr",
      .syntax = "_ extend_aggr[attributes; functions]",
      .doc = "The tuples with a new attribute: the fold of an attribute up to this tuple by a function of two values.",
      .detail =
          "The first tuple gets its own value, every further one the function of the previous result and its own "
          "value. Where a second attribute, a bool, is TRUE, the fold begins anew. Undefined values are passed to "
          "the function.",
      .stream = stream_operator(map_extend_aggr),
      .signatures = {"(stream(tuple) NAMES ((NAME (map DATA DATA DATA)))) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples =
          {{runs + "extend_aggr[A; S: fun(a: int, b: int) a + b] project[S] consume", "((1) (3) (6) (10))"},
           {runs + "extend_aggr[A, R; S: fun(a: int, b: int) a + b] project[S] consume", "((1) (3) (3) (7))"},
           {"[const rel(tuple([A: int])) value ((1) (undefined) (2))] feed extend_aggr[A; S: fun(a: int, b: int) "
            "a + b] consume",
            "((1 1) (undefined undefined) (2 undefined))"}},
      .query_errors = {{"query " + runs + "extend_aggr[R; S: fun(a: int, b: int) a + b] count",
                        "extend_aggr: expected a function of type (map bool bool bool), got (map int int int)"},
                       {"query " + runs + "extend_aggr[A, A; S: fun(a: int, b: int) a + b] count",
                        "extend_aggr: expected a second attribute of type bool, got int"},
                       {"query " + runs + "extend_aggr[A; R: fun(a: int, b: int) a + b] count",
                        "extend_aggr: duplicate attribute name 'R'"}},
  });
  group.add({
      .name = "aggregateB",
      .syntax = "_ aggregateB[attribute; fun; _]",
      .doc = "The values of an attribute combined by a function of two values; the last argument is the result for "
             "an empty stream.",
      .detail =
          "Neighbours are combined in a balanced tree: the result for a, b, c and d is f(f(a, b), f(c, d)). So the "
          "function should be associative. Undefined values are passed to the function.",
      .stream = stream_operator(map_aggregate),
      .signatures = {"(stream(tuple) NAME (map DATA DATA DATA) DATA) -> DATA"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 5) transformstream aggregateB[Elem; fun(a: int, b: int) a * b; 0]", "120"},
                         {"intstream(1, 0) transformstream aggregateB[Elem; fun(a: int, b: int) a * b; 7]", "7"},
                         {"[const rel(tuple([A: int])) value ((1) (undefined))] feed "
                          "aggregateB[A; fun(a: int, b: int) a + b; 0]",
                          "undefined"}},
      .query_errors = {{"query intstream(1, 5) transformstream aggregateB[Elem; fun(a: int, b: int) a < b; 0]",
                        "aggregateB: expected a function of type (map int int int), got (map int int bool)"},
                       {"query intstream(1, 5) transformstream aggregateB[Elem; fun(a: int, b: int) a + b; TRUE]",
                        "aggregateB: expected int, got bool"}},
  });
}

}  // namespace queries
