// getMinVal, getMaxVal: the least and the greatest of several values.
#include <algorithm>

#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

/// The type that all arguments are of or can be converted to.
Result<TypeExpr> type_for_all(const MappingCheck& check) {
  std::vector<TypeExpr> types;
  for (std::size_t i = 0; i < check.count(); ++i) {
    if (!is_value_type(check[i].type)) return check.expected("values", check[i].type);
    types.push_back(check[i].type);
  }
  const TypeExpr* best = nullptr;
  std::size_t cheapest = 0;
  for (const TypeExpr& candidate : types) {
    std::size_t sum = 0;
    const bool fits = std::ranges::all_of(types, [&](const TypeExpr& type) {
      const auto cost = algebra3d::conversion_cost(type, candidate.name());
      sum += cost.value_or(0);
      return cost.has_value();
    });
    if (!fits || (best != nullptr && sum >= cheapest)) continue;
    best = &candidate;
    cheapest = sum;
  }
  if (best != nullptr) return *best;
  return check.error("expected values of one type, got " + algebra3d::argument_list_text(types));
}

/// The first of the values that none comes before, or after; undefined if one of them is.
Result<Value> extreme(const std::vector<Datum>& given, const std::vector<Conversion>& conversions, bool is_least) {
  std::optional<Value> best;
  for (std::size_t i = 0; i < given.size(); ++i) {
    A3D_ASSIGN(const Value loaded, given[i].value().loaded());
    const Value value = converted(loaded, conversions[i]);
    if (!value.is_defined()) return value;
    if (!best || (is_least ? compare(value, *best) < 0 : compare(value, *best) > 0)) best = value;
  }
  return *best;
}

TypeMapping map_extreme_value(const char* op, bool is_least) {
  return [=](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(op, arguments);
    A3D_ASSIGN(const TypeExpr type, type_for_all(check));
    std::vector<Conversion> conversions;
    for (std::size_t i = 0; i < check.count(); ++i) {
      A3D_ASSIGN(const Conversion conversion, check.conversion(i, type));
      conversions.push_back(conversion);
    }
    return BoundOperator{type, [=](const std::vector<Datum>& given, Context&) -> Result<Datum> {
                           A3D_ASSIGN(Value value, extreme(given, conversions, is_least));
                           return Datum{std::move(value)};
                         }};
  };
}

}  // namespace

void register_extremes(algebra3d::OperatorGroup& group) {
  constexpr const char* kDetail =
      "The values have one type; ints with reals become reals, strings with texts become texts. Of equal values the "
      "first is taken. Undefined if one value is.";
  group.add({
      .name = "getMinVal",
      .syntax = "getMinVal(_ ...)",
      .doc = "The least of several values, in the order of their type.",
      .detail = kDetail,
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator(map_extreme_value("getMinVal", true)),
      .signatures = {"(DATA ...) -> DATA"},
      .query_examples = {{"getMinVal(45, -45, 12, 0, -75, 5)", "-75"},
                         {"getMinVal(1, 0.5)", "0.5"},
                         {"getMinVal(1, [const int value undefined])", "undefined"}},
      .query_errors = {{R"(query getMinVal(1, "a"))", "getMinVal: expected values of one type, got (int string)"},
                       {"query getMinVal(intstream(1, 2))", "getMinVal: expected values, got (stream int)"}},
  });
  group.add({
      .name = "getMaxVal",
      .syntax = "getMaxVal(_ ...)",
      .doc = "The greatest of several values, in the order of their type.",
      .detail = kDetail,
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator(map_extreme_value("getMaxVal", false)),
      .signatures = {"(DATA ...) -> DATA"},
      .query_examples = {{"getMaxVal(45, -45, 12, 0, -75, 5)", "45"},
                         {R"(getMaxVal("a", 'b'))", "'b'"},
                         {"getMaxVal(1, [const int value undefined])", "undefined"}},
      .query_errors = {{R"(query getMaxVal(1, "a"))", "getMaxVal: expected values of one type, got (int string)"}},
  });
}

}  // namespace queries
