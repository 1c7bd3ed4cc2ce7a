#include "queries/language/index_rewrites.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "base/propagate.h"
#include "queries/language/index_condition.h"
#include "queries/language/index_feed.h"
#include "queries/language/plan_views.h"

namespace queries {
namespace {

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

/// The indexes of a relation that serve a part of a predicate.
Result<std::vector<IndexChoice>> index_choices(const std::string& relation, const TypedNode& predicate,
                                               const RewriteContext& rewriting) {
  std::vector<IndexChoice> choices;
  const std::vector<IndexCondition> conditions = index_conditions(predicate);
  if (conditions.empty()) return choices;
  A3D_ASSIGN(const auto indexes, rewriting.objects.indexes_of(relation));
  for (const IndexCondition& condition : conditions)
    for (const auto& index : indexes) {
      const TypeExpr limit = condition.limit == nullptr ? TypeExpr() : condition.limit->type();
      if (index.attribute == condition.attribute &&
          can_serve(index.type, condition.use, condition.operand->type(), limit, rewriting.registry))
        choices.push_back({index, condition.use, condition.operand, condition.limit});
    }
  add_closed_ranges(choices);
  return choices;
}

}  // namespace

Status read_by_index(const BoundOperator& bound, std::vector<TypedPtr>& arguments, const RewriteContext& rewriting) {
  if (!std::holds_alternative<SelectsElements>(bound.role)) return {};
  const auto scan = call_with<ScansRelation>(*arguments[0]);
  const auto function = view_as<FunctionView>(*arguments[1]);
  if (!scan || !function) return {};
  const std::string relation = scanned_relation(*scan);
  if (relation.empty()) return {};
  A3D_ASSIGN(std::vector<IndexChoice> choices, index_choices(relation, function->body, rewriting));
  if (choices.empty()) return {};
  const auto node = std::make_shared<IndexFeedNode>(arguments[0]->type(), std::move(choices), scan->arguments[0],
                                                    rewriting.objects, arguments[0]->place());
  std::optional<std::uint64_t> estimate;
  if (rewriting.is_explained && !rewriting.is_in_function) estimate = node->describe_plan(rewriting.context);
  arguments[0] = arguments[0]->replaced_by(node, estimate);
  return {};
}

}  // namespace queries
