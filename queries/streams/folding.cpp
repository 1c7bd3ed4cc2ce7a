// aggregateB: a function of two values over all values of an attribute.
#include <array>

#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

/// Folds values pairwise, so that every value takes part in no more than log n applications: what matters when the
/// results grow, as unions of solids do. Neighbours are combined only, the earlier one first.
class BalancedFold {
 public:
  explicit BalancedFold(const Function& function) : function_(function) {}

  Status add(Value value) {
    results_.push_back({std::move(value), 0});
    while (results_.size() > 1 && results_[results_.size() - 2].level == results_.back().level)
      RETURN_IF_ERROR(combine_last());
    return {};
  }
  /// Nothing if no value was added.
  Result<std::optional<Value>> finish() {
    while (results_.size() > 1) RETURN_IF_ERROR(combine_last());
    return results_.empty() ? std::optional<Value>() : std::optional(results_.front().value);
  }

 private:
  struct Partial {
    Value value;
    int level;  // the result of 2^level values
  };

  Status combine_last() {
    Partial& left = results_[results_.size() - 2];
    const std::array<Datum, 2> both = {Datum{left.value}, Datum{results_.back().value}};
    ASSIGN_OR_RETURN(Datum combined, function_.call(both));
    left = {std::get<Value>(std::move(combined.content)), left.level + 1};
    results_.pop_back();
    return {};
  }

  const Function& function_;
  std::vector<Partial> results_;  // levels descend
};

Result<Plan> map_aggregate(std::span<const ArgumentType> arguments) {
  const MappingCheck check("aggregateB", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t index, check.attribute(1, tuple));
  const TypeExpr type = tuple.attributes()[index].type;
  const TypeExpr wanted = TypeExpr::map({type, type}, type);
  if (!(check[2].type == wanted)) return check.expected("a function of type " + wanted.text(), check[2].type);
  ASSIGN_OR_RETURN(const bool to_real, check.promotion(3, type));
  return Plan{type, [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                BalancedFold fold(given[2].function());
                RETURN_IF_ERROR(for_each_tuple(*given[0].tuples(), context, [&](const TuplePtr& next) {
                  return fold.add(next->attributes[index]);
                }));
                ASSIGN_OR_RETURN(const auto result, fold.finish());
                return Datum{result ? *result : promoted(given[3].value(), to_real)};
              }};
}

}  // namespace

void register_folding(algebra3d::Registry& registry) {
  registry.add({
      .name = "aggregateB",
      .syntax = "_ aggregateB[attribute; fun; _]",
      .doc = "The values of an attribute, combined by a function of two values; the last argument for an empty stream.",
      .detail =
          "The function is applied to neighbours, in a balanced way: of a, b, c and d the result is f(f(a, b), f(c, "
          "d)). So it should be associative. Undefined values are given to the function like others.",
      .stream = stream_operator(map_aggregate),
      .signatures = {"(stream(tuple) NAME (map DATA DATA DATA) DATA) -> DATA"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 5) transformstream aggregateB[Elem; fun(a: int, b: int) a * b; 0]", "120"},
                   {"intstream(1, 0) transformstream aggregateB[Elem; fun(a: int, b: int) a * b; 7]", "7"},
                   {"[const rel(tuple([A: int])) value ((1) (undefined))] feed "
                    "aggregateB[A; fun(a: int, b: int) a + b; 0]",
                    "undefined"}},
      .errors = {{"query intstream(1, 5) transformstream aggregateB[Elem; fun(a: int, b: int) a < b; 0]",
                  "aggregateB: expected a function of type (map int int int), got (map int int bool)"},
                 {"query intstream(1, 5) transformstream aggregateB[Elem; fun(a: int, b: int) a + b; TRUE]",
                  "aggregateB: expected int, got bool"}},
  });
}

}  // namespace queries
