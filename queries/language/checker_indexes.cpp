// The part of the checker that lets a filter read by an index, and that estimates numbers of tuples for plans.
#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>

#include "base/diagnostics.h"
#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/index_condition.h"
#include "queries/language/index_feed.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

using algebra3d::Diagnostics;

/// The only operand of an operator of this name; null if the expression is something else.
const Expression* operand_of(const ExpressionPtr& expression, std::string_view name) {
  const auto* application = expression == nullptr ? nullptr : std::get_if<Application>(&expression->node);
  if (application == nullptr || application->name != name || application->arguments.size() != 1) return nullptr;
  return application->arguments[0].value.get();
}

/// Adds the range of a lower bound and an upper one on the same index.
void add_closed_ranges(std::vector<IndexChoice>& choices) {
  std::vector<IndexChoice> ranges;
  for (const IndexChoice& low : choices) {
    const auto is_upper_bound = [&](const IndexChoice& other) {
      return other.use == IndexUse::at_most && other.index.name == low.index.name;
    };
    if (low.use != IndexUse::at_least) continue;
    const auto high = std::ranges::find_if(choices, is_upper_bound);
    if (high != choices.end()) ranges.push_back({low.index, IndexUse::between, low.operand, high->operand});
  }
  std::ranges::move(ranges, std::back_inserter(choices));
}

}  // namespace

/// The name of the stored relation that an expression is; empty for anything else.
std::string Checker::stored_relation(const Expression& expression) {
  const auto* use = std::get_if<NameUse>(&expression.node);
  if (use == nullptr) return {};
  const auto is_named = [&](const Parameter& parameter) { return parameter.name == use->name; };
  for (const Scope& scope : scopes_)
    if (std::ranges::any_of(scope.parameters, is_named)) return {};
  const auto type = objects_.type_of(use->name);
  return type && *type && (*type)->is_relation() ? use->name : std::string();
}

bool Checker::is_function_object(const std::string& name) {
  const auto type = objects_.type_of(name);
  return type && *type && (*type)->is_function();
}

// In place of `R feed` in `R feed filter[...]`; null if no index serves a part of the condition.
Result<TypedPtr> Checker::indexed_feed(const Application& filter) {
  const Expression* const relation = operand_of(filter.arguments[0].value, "feed");
  if (relation == nullptr || filter.arguments[1].value == nullptr || is_function_object("feed")) return TypedPtr();
  const std::string name = stored_relation(*relation);
  if (name.empty()) return TypedPtr();
  const auto conditions = index_conditions(*filter.arguments[1].value, registry_,
                                           [this](const std::string& each) { return is_function_object(each); });
  if (conditions.empty()) return TypedPtr();
  A3D_ASSIGN(const auto indexes, objects_.indexes_of(name));
  std::vector<IndexChoice> choices;
  for (const IndexCondition& condition : conditions)
    for (const auto& index : indexes) {
      if (index.attribute != condition.attribute) continue;
      if (auto choice = index_choice(index, condition)) choices.push_back(std::move(*choice));
    }
  if (choices.empty()) return TypedPtr();
  add_closed_ranges(choices);
  A3D_ASSIGN(TypedPtr source, check(*relation));
  return recorded_feed(std::move(source), std::move(choices), relation->place);
}

/// Null if the index does not serve the condition. Operands that are wrong are reported where the filter is checked.
std::unique_ptr<IndexChoice> Checker::index_choice(const ObjectSource::IndexName& index,
                                                   const IndexCondition& condition) {
  Diagnostics unheard;
  Context context = context_.with(unheard);
  Checker silent(registry_, objects_, context);
  silent.scopes_ = scopes_;
  const auto operand = silent.check(*condition.operand);
  if (!operand) return nullptr;
  TypedPtr limit;
  if (condition.limit != nullptr) {
    auto checked = silent.check(*condition.limit);
    if (!checked) return nullptr;
    limit = std::move(checked).value();
  }
  const TypeExpr limit_type = limit == nullptr ? TypeExpr() : limit->type();
  if (!can_serve(index.type, condition.use, (*operand)->type(), limit_type, registry_)) return nullptr;
  return std::make_unique<IndexChoice>(IndexChoice{index, condition.use, *operand, std::move(limit)});
}

Result<TypedPtr> Checker::recorded_feed(TypedPtr relation, std::vector<IndexChoice> choices, const SourcePlace& place) {
  const TypeExpr type = relation->type();
  const TypeExpr stream = TypeExpr::stream(type.element());
  const auto node = std::make_shared<IndexFeedNode>(stream, std::move(choices), std::move(relation), objects_, place);
  if (recorder_ == nullptr) return TypedPtr(node);
  const std::size_t step = recorder_->begin("feed");
  std::optional<std::uint64_t> estimate;
  std::string how = node->text();
  if (scopes_.empty()) {
    if (auto plan = node->plan(context_)) {
      estimate = plan->tuple_count;
      how = std::move(plan->text);
    }
  }
  recorder_->describe(step, how, estimate);
  return recorder_->finish(step, algebra3d::argument_list_text(std::array{type}) + " -> " + stream.text(), node);
}

/// The number of tuples that an operator returns, if it is a scan of a stored relation.
std::optional<std::uint64_t> Checker::estimated_tuples(const Application& application) {
  if (application.name != "feed" || application.arguments.size() != 1 || application.arguments[0].value == nullptr)
    return std::nullopt;
  const std::string name = stored_relation(*application.arguments[0].value);
  if (name.empty()) return std::nullopt;
  const auto relation = objects_.value_of(name);
  if (!relation) return std::nullopt;
  const auto count = relation->relation()->count();
  return count ? std::optional(static_cast<std::uint64_t>(*count)) : std::nullopt;
}

}  // namespace queries
