#include "queries/language/hash_rewrites.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "queries/language/index_condition.h"
#include "queries/language/plan_views.h"
#include "queries/streams/batch.h"

namespace queries {
namespace {

/// The attribute of a pair that an expression is, counted over both tuples.
std::optional<std::size_t> attribute_of_pair(const TypedNode& expression, std::size_t left_count) {
  const auto use = view_as<AttributeView>(expression);
  const auto tuple = use ? view_as<ParameterView>(use->tuple) : std::nullopt;
  if (!tuple || tuple->level != 0) return std::nullopt;
  return tuple->index * left_count + use->index;
}

/// Types whose equality is that of their keys.
bool is_key_type(const TypeExpr& type) {
  return type.is("int") || type.is("string");
}

/// The attributes that a condition wants to be equal, one of each tuple.
std::optional<JoinKeys> equal_attributes(const TypedNode& condition, std::size_t left_count) {
  const auto call = view_as<ValueCallView>(condition);
  if (!call || call->call.op->name != "=" || call->arguments.size() != 2) return std::nullopt;
  const TypeExpr& type = call->arguments[0]->type();
  if (!is_key_type(type) || type != call->arguments[1]->type()) return std::nullopt;
  auto left = attribute_of_pair(*call->arguments[0], left_count);
  auto right = attribute_of_pair(*call->arguments[1], left_count);
  if (!left || !right) return std::nullopt;
  if (*left > *right) std::swap(left, right);
  if (*left >= left_count || *right < left_count) return std::nullopt;
  return JoinKeys{*left, *right - left_count};
}

std::optional<JoinKeys> join_keys_in(const TypedNode& predicate, std::size_t left_count) {
  const auto function = view_as<FunctionView>(predicate);
  if (!function) return std::nullopt;
  for (const TypedPtr& condition : conjuncts(function->body))
    if (const auto keys = equal_attributes(*condition, left_count)) return keys;
  return std::nullopt;
}

/// The aggregate that the function of a group computes; nothing if it is neither the number of the tuples nor an
/// aggregate of an attribute.
std::optional<GroupAggregate> group_aggregate(const TypedNode& function) {
  const auto view = view_as<FunctionView>(function);
  const auto call = view ? view_as<StreamCallView>(view->body) : std::nullopt;
  if (!call) return std::nullopt;
  const TypedNode* input = call->arguments[0].get();
  if (const auto scan = call_with<ScansRelation>(*input)) input = scan->arguments[0].get();
  const auto group = view_as<ParameterView>(*input);
  if (!group || group->level != 0) return std::nullopt;
  if (std::holds_alternative<CountsElements>(call->bound.role)) return GroupAggregate();
  const auto* aggregate = std::get_if<AggregatesAttribute>(&call->bound.role);
  if (aggregate == nullptr) return std::nullopt;
  return GroupAggregate{aggregate->call, aggregate->attribute};
}

std::optional<std::vector<GroupAggregate>> group_aggregates(const TypedNode& functions) {
  const auto list = view_as<ListView>(functions);
  if (!list) return std::nullopt;
  std::vector<GroupAggregate> aggregates;
  for (const TypedPtr& function : list->elements) {
    auto aggregate = group_aggregate(*function);
    if (!aggregate) return std::nullopt;
    aggregates.push_back(*std::move(aggregate));
  }
  return aggregates;
}

/// Whether an order is of these attributes, each once, and all of them have types that stand in columns.
bool is_order_of(std::vector<std::size_t> keys, const std::vector<SortKey>& order, const TypeExpr& tuple) {
  std::vector<std::size_t> ordered;
  for (const SortKey& key : order) ordered.push_back(key.attribute);
  std::ranges::sort(keys);
  std::ranges::sort(ordered);
  return keys == ordered && std::ranges::all_of(keys, [&](std::size_t key) {
           return type_in_columns(tuple.attributes()[key].type) != nullptr;
         });
}

}  // namespace

void pair_by_hash(BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  if (const auto* pairs = std::get_if<PairsTuples>(&bound.role); pairs != nullptr && pairs->has_predicate) {
    if (const auto keys = join_keys_in(*arguments[2], pairs->left_count))
      bound = BoundOperator(pairs->with_equal(*keys));
    return;
  }
  if (!std::holds_alternative<SelectsElements>(bound.role)) return;
  const auto product = call_with<PairsTuples>(*arguments[0]);
  if (!product) return;
  const auto& pairs = std::get<PairsTuples>(product->bound.role);
  if (pairs.has_predicate || pairs.keys) return;
  if (const auto keys = join_keys_in(*arguments[1], pairs.left_count))
    arguments[0] = with_operator(arguments[0], *product, pairs.with_equal(*keys));
}

void group_by_hash(BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  const auto* groups = std::get_if<GroupsTuples>(&bound.role);
  const auto* duplicates = std::get_if<RemovesDuplicates>(&bound.role);
  if (groups == nullptr && duplicates == nullptr) return;
  const auto sort = call_with<SortsTuples>(*arguments[0]);
  if (!sort) return;
  const auto& role = std::get<SortsTuples>(sort->bound.role);
  const TypeExpr tuple = arguments[0]->type().element();
  std::vector<std::size_t> keys(tuple.attributes().size());
  std::iota(keys.begin(), keys.end(), std::size_t{0});
  if (!is_order_of(groups != nullptr ? groups->keys : keys, role.order, tuple)) return;
  if (groups == nullptr) {
    bound = BoundOperator(duplicates->hashed(role.order));
  } else {
    auto aggregates = group_aggregates(*arguments[2]);
    if (!aggregates) return;
    bound = BoundOperator(groups->hashed(role.order, *std::move(aggregates)));
  }
  arguments[0] = with_operator(arguments[0], *sort, role.left_out());
}

}  // namespace queries
