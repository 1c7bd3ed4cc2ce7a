#include "queries/language/index_condition.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "algebra3d/operators/registry/operator.h"

namespace queries {
namespace {

/// How an operator limits its first operand and its second one.
struct IndexUses {
  IndexUse of_first, of_second;
};

struct IndexedComparison {
  std::string_view name;
  IndexUses uses;
};
constexpr std::array kComparisons{IndexedComparison{"=", {IndexUse::equals, IndexUse::equals}},
                                  IndexedComparison{"<", {IndexUse::at_most, IndexUse::at_least}},
                                  IndexedComparison{"<=", {IndexUse::at_most, IndexUse::at_least}},
                                  IndexedComparison{">", {IndexUse::at_least, IndexUse::at_most}},
                                  IndexedComparison{">=", {IndexUse::at_least, IndexUse::at_most}}};

std::optional<IndexUses> index_uses(const algebra3d::Operator& op) {
  if (const auto* const known = std::ranges::find(kComparisons, op.name, &IndexedComparison::name);
      known != kComparisons.end())
    return known->uses;
  using algebra3d::BoxCondition;
  switch (op.boxes) {
    case BoxCondition::meet:
      return IndexUses{IndexUse::meets, IndexUse::meets};
    case BoxCondition::first_is_inside:
      return IndexUses{IndexUse::is_inside, IndexUse::contains};
    case BoxCondition::first_encloses:
      return IndexUses{IndexUse::contains, IndexUse::is_inside};
    case BoxCondition::are_near:
      return IndexUses{IndexUse::is_near, IndexUse::is_near};
    case BoxCondition::none:
      break;
  }
  return std::nullopt;
}

/// The name of the attribute in `.A` or `bbox(.A)`.
std::optional<std::string> attribute_in(const TypedNode& expression) {
  const NodeView view = expression.view();
  if (const auto* call = std::get_if<ValueCallView>(&view))
    return call->call.op->name == "bbox" && call->arguments.size() == 1 &&
                   std::holds_alternative<AttributeView>(call->arguments[0]->view())
               ? attribute_in(*call->arguments[0])
               : std::nullopt;
  const auto* use = std::get_if<AttributeView>(&view);
  if (use == nullptr) return std::nullopt;
  const NodeView tuple = use->tuple.view();
  const auto* parameter = std::get_if<ParameterView>(&tuple);
  if (parameter == nullptr || parameter->level != 0 || parameter->index != 0) return std::nullopt;
  return use->tuple.type().attributes()[use->index].name;
}

/// The condition that an operator on two operands, or three with a limit, makes.
std::optional<IndexCondition> index_condition(const ValueCallView& call) {
  const auto known = index_uses(*call.call.op);
  if (!known) return std::nullopt;
  const bool has_limit = known->of_first == IndexUse::is_near;
  if (call.arguments.size() != (has_limit ? 3U : 2U)) return std::nullopt;
  if (has_limit && !is_same_for_all_tuples(*call.arguments[2])) return std::nullopt;
  for (const std::size_t own : {0U, 1U}) {
    const TypedPtr& other = call.arguments[1 - own];
    auto attribute = attribute_in(*call.arguments[own]);
    if (!attribute || !is_same_for_all_tuples(*other)) continue;
    return IndexCondition{own == 0 ? known->of_first : known->of_second, *std::move(attribute), other->unmeasured(),
                          has_limit ? call.arguments[2]->unmeasured() : nullptr};
  }
  return std::nullopt;
}

/// `.A between[low, high]`
std::optional<IndexCondition> range_condition(const ValueCallView& call) {
  auto attribute = attribute_in(*call.arguments[0]);
  if (!attribute || !is_same_for_all_tuples(*call.arguments[1]) || !is_same_for_all_tuples(*call.arguments[2]))
    return std::nullopt;
  return IndexCondition{IndexUse::between, *std::move(attribute), call.arguments[1]->unmeasured(),
                        call.arguments[2]->unmeasured()};
}

/// Conditions of which one holds wherever a condition on an ordered index is FALSE (equal values included); empty if an
/// index does not help then.
IndexConditions negated(IndexCondition condition) {
  if (condition.use == IndexUse::at_least || condition.use == IndexUse::at_most) {
    condition.use = condition.use == IndexUse::at_least ? IndexUse::at_most : IndexUse::at_least;
    return {std::move(condition)};
  }
  if (condition.use != IndexUse::between) return {};
  IndexCondition above{IndexUse::at_least, condition.attribute, condition.limit};
  return {{IndexUse::at_most, condition.attribute, condition.operand}, std::move(above)};
}

/// Conditions for indexes of which one holds wherever a condition is TRUE or, if `is_negated`, FALSE; empty if indexes
/// do not help.
IndexConditions alternatives(const TypedNode& condition, bool is_negated) {
  const NodeView view = condition.view();
  const auto* call = std::get_if<ValueCallView>(&view);
  if (call == nullptr) return {};
  const std::string& name = call->call.op->name;
  if (name == "not") return alternatives(*call->arguments[0], !is_negated);
  if (name == "and" || name == "or") {
    IndexConditions first = alternatives(*call->arguments[0], is_negated);
    IndexConditions second = alternatives(*call->arguments[1], is_negated);
    // One part of a conjunction suffices.
    if ((name == "and") != is_negated) return first.empty() ? second : first;
    if (first.empty() || second.empty()) return {};
    std::ranges::move(second, std::back_inserter(first));
    return first;
  }
  auto single = name == "between" && call->arguments.size() == 3 ? range_condition(*call) : index_condition(*call);
  if (!single) return {};
  return is_negated ? negated(*std::move(single)) : IndexConditions{*std::move(single)};
}

void add_conjuncts(const TypedNode& predicate, std::vector<TypedPtr>& conditions) {
  const NodeView view = predicate.view();
  const auto* call = std::get_if<ValueCallView>(&view);
  if (call == nullptr || call->call.op->name != "and") {
    conditions.push_back(predicate.shared_from_this());
    return;
  }
  for (const TypedPtr& operand : call->arguments) add_conjuncts(*operand, conditions);
}

/// Answers for each kind of node whether the value is the same for all tuples.
struct SameForAllTuples {
  bool operator()(const ConstantView&) const { return true; }
  bool operator()(const ObjectView&) const { return true; }
  bool operator()(const ParameterView& parameter) const { return parameter.level > 0; }
  bool operator()(const AttributeView& use) const { return is_same_for_all_tuples(use.tuple); }
  bool operator()(const ConversionView& conversion) const { return is_same_for_all_tuples(conversion.argument); }
  bool operator()(const ValueCallView& view) const {
    return view.call.op->is_pure_in(*view.call.overload) &&
           std::ranges::all_of(view.arguments, [](const TypedPtr& each) { return is_same_for_all_tuples(*each); });
  }
  template <typename Other>
  bool operator()(const Other&) const {
    return false;
  }
};

}  // namespace

bool is_same_for_all_tuples(const TypedNode& expression) {
  return std::visit(SameForAllTuples(), expression.view());
}

std::vector<TypedPtr> conjuncts(const TypedNode& predicate) {
  std::vector<TypedPtr> conditions;
  add_conjuncts(predicate, conditions);
  return conditions;
}

std::vector<IndexConditions> index_conditions(const TypedNode& predicate) {
  std::vector<IndexConditions> conditions;
  for (const TypedPtr& each : conjuncts(predicate))
    if (IndexConditions found = alternatives(*each, false); !found.empty()) conditions.push_back(std::move(found));
  return conditions;
}

}  // namespace queries
