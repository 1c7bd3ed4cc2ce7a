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
void add_closed_ranges(std::vector<IndexSearch>& searches) {
  std::vector<IndexSearch> ranges;
  for (const IndexSearch& lower : searches) {
    const IndexChoice& low = lower.front();
    const auto is_upper_bound = [&](const IndexSearch& other) {
      return other.size() == 1 && other.front().use == IndexUse::at_most && other.front().index.name == low.index.name;
    };
    if (lower.size() > 1 || low.use != IndexUse::at_least) continue;
    const auto high = std::ranges::find_if(searches, is_upper_bound);
    if (high != searches.end()) ranges.push_back({{low.index, IndexUse::between, low.operand, high->front().operand}});
  }
  std::ranges::move(ranges, std::back_inserter(searches));
}

/// The indexes that serve a condition.
IndexSearch serving(const IndexCondition& condition, const std::vector<ObjectSource::IndexName>& indexes,
                    const RewriteContext& rewriting) {
  IndexSearch choices;
  const TypeExpr limit = condition.limit == nullptr ? TypeExpr() : condition.limit->type();
  for (const auto& index : indexes)
    if (index.attribute == condition.attribute &&
        can_serve(index.type, condition.use, condition.operand->type(), limit, rewriting.registry))
      choices.push_back({index, condition.use, condition.operand, condition.limit});
  return choices;
}

/// The searches in indexes of a relation that serve a part of a predicate.
Result<std::vector<IndexSearch>> index_searches(const std::string& relation, const TypedNode& predicate,
                                                const RewriteContext& rewriting) {
  std::vector<IndexSearch> searches;
  const std::vector<IndexConditions> conditions = index_conditions(predicate);
  if (conditions.empty()) return searches;
  A3D_ASSIGN(const auto indexes, rewriting.objects.indexes_of(relation));
  for (const IndexConditions& alternatives : conditions) {
    IndexSearch all;
    for (const IndexCondition& condition : alternatives) {
      IndexSearch choices = serving(condition, indexes, rewriting);
      if (alternatives.size() == 1)
        for (IndexChoice& choice : choices) searches.push_back({std::move(choice)});
      else if (!choices.empty())
        all.push_back(std::move(choices.front()));
    }
    if (alternatives.size() > 1 && all.size() == alternatives.size()) searches.push_back(std::move(all));
  }
  add_closed_ranges(searches);
  return searches;
}

}  // namespace

Status read_by_index(const BoundOperator& bound, std::vector<TypedPtr>& arguments, const RewriteContext& rewriting) {
  if (!std::holds_alternative<SelectsElements>(bound.role)) return {};
  const auto scan = call_with<ScansRelation>(*arguments[0]);
  const auto function = view_as<FunctionView>(*arguments[1]);
  if (!scan || !function) return {};
  const std::string relation = scanned_relation(*scan);
  if (relation.empty()) return {};
  A3D_ASSIGN(std::vector<IndexSearch> searches, index_searches(relation, function->body, rewriting));
  if (searches.empty()) return {};
  const auto node = std::make_shared<IndexFeedNode>(arguments[0]->type(), std::move(searches), scan->arguments[0],
                                                    rewriting.objects, arguments[0]->place());
  std::optional<std::uint64_t> estimate;
  if (rewriting.is_explained && !rewriting.is_in_function) estimate = node->describe_plan(rewriting.context);
  arguments[0] = arguments[0]->replaced_by(node, estimate);
  return {};
}

}  // namespace queries
