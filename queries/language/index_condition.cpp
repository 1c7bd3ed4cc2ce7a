#include "queries/language/index_condition.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "queries/streams/value_operators.h"

namespace queries {
namespace {

using IsFunction = std::function<bool(const std::string& name)>;
using PlaceKind = algebra3d::SyntaxPattern::PlaceKind;

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

std::optional<IndexUses> index_uses(const std::string& name, const algebra3d::Registry& registry) {
  if (const auto* const known = std::ranges::find(kComparisons, name, &IndexedComparison::name);
      known != kComparisons.end())
    return known->uses;
  using algebra3d::BoxCondition;
  const algebra3d::Operator* const op = registry.find_operator(name);
  switch (op == nullptr ? BoxCondition::none : op->boxes) {
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

/// The expressions that an operator is applied to; none if some argument is something else.
std::vector<ExpressionPtr> operands_of(const Application& application) {
  std::vector<ExpressionPtr> operands;
  for (const Argument& argument : application.arguments) {
    if (argument.kind != PlaceKind::value || argument.value == nullptr || argument.misread) return {};
    operands.push_back(argument.value);
  }
  return operands;
}

/// The name of the attribute in `.A` or `bbox(.A)`.
std::optional<std::string> attribute_in(const Expression& expression) {
  if (const auto* use = std::get_if<AttributeUse>(&expression.node))
    return use->parameter == 1 ? std::optional(use->name) : std::nullopt;
  const auto* application = std::get_if<Application>(&expression.node);
  if (application == nullptr || application->name != "bbox") return std::nullopt;
  const auto operands = operands_of(*application);
  const auto* use = operands.size() == 1 ? std::get_if<AttributeUse>(&operands[0]->node) : nullptr;
  return use != nullptr && use->parameter == 1 ? std::optional(use->name) : std::nullopt;
}

bool is_call_of_function(const Expression& expression, const IsFunction& is_function) {
  const auto* application = std::get_if<Application>(&expression.node);
  return application != nullptr && application->is_call && is_function(application->name);
}

std::optional<IndexCondition> index_condition(const Application& application, const algebra3d::Registry& registry,
                                              const IsFunction& is_function) {
  const std::optional<IndexUses> known = index_uses(application.name, registry);
  if (!known) return std::nullopt;
  const std::vector<ExpressionPtr> operands = operands_of(application);
  const bool has_limit = known->of_first == IndexUse::is_near;
  if (operands.size() != (has_limit ? 3U : 2U)) return std::nullopt;
  if (has_limit && !is_same_for_all_tuples(*operands[2], registry)) return std::nullopt;
  for (const std::size_t own : {0U, 1U}) {
    const ExpressionPtr& other = operands[1 - own];
    const auto attribute = attribute_in(*operands[own]);
    if (!attribute || is_call_of_function(*operands[own], is_function)) continue;
    if (!is_same_for_all_tuples(*other, registry)) continue;
    return IndexCondition{own == 0 ? known->of_first : known->of_second, *attribute, other,
                          has_limit ? operands[2] : nullptr, application.name};
  }
  return std::nullopt;
}

void add_conditions(const Expression& predicate, const algebra3d::Registry& registry, const IsFunction& is_function,
                    std::vector<IndexCondition>& conditions) {
  const auto* application = std::get_if<Application>(&predicate.node);
  if (application == nullptr || is_call_of_function(predicate, is_function)) return;
  if (application->name == "and") {
    for (const ExpressionPtr& operand : operands_of(*application))
      add_conditions(*operand, registry, is_function, conditions);
    return;
  }
  if (auto condition = index_condition(*application, registry, is_function))
    conditions.push_back(std::move(*condition));
}

}  // namespace

bool is_same_for_all_tuples(const Expression& expression, const algebra3d::Registry& registry) {
  if (std::holds_alternative<Literal>(expression.node) || std::holds_alternative<TypedLiteral>(expression.node) ||
      std::holds_alternative<HostValue>(expression.node) || std::holds_alternative<NameUse>(expression.node))
    return true;
  const auto* application = std::get_if<Application>(&expression.node);
  if (application == nullptr) return false;
  const algebra3d::Operator* const op = registry.find_operator(application->name);
  if (op == nullptr || takes_streams(*op) || !op->is_pure || op->kind() != algebra3d::OperatorKind::scalar)
    return false;
  const std::vector<ExpressionPtr> operands = operands_of(*application);
  return operands.size() == application->arguments.size() &&
         std::ranges::all_of(operands,
                             [&](const ExpressionPtr& each) { return is_same_for_all_tuples(*each, registry); });
}

std::vector<IndexCondition> index_conditions(const Expression& predicate, const algebra3d::Registry& registry,
                                             const std::function<bool(const std::string& name)>& is_function) {
  std::vector<IndexCondition> conditions;
  add_conditions(predicate, registry, is_function, conditions);
  return conditions;
}

}  // namespace queries
