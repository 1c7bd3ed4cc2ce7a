#include "queries/language/rewriting.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/index_condition.h"
#include "queries/language/index_feed.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

template <typename View>
std::optional<View> view_as(const TypedNode& node) {
  NodeView view = node.view();
  auto* found = std::get_if<View>(&view);
  return found == nullptr ? std::nullopt : std::optional<View>(*found);
}

/// The call of an operator with this role; nothing if the node is something else.
template <typename Role>
std::optional<StreamCallView> call_with(const TypedNode& node) {
  auto call = view_as<StreamCallView>(node);
  return call && std::holds_alternative<Role>(call->bound.role) ? call : std::nullopt;
}

/// The name of the stored relation that a call scans; empty if it scans another one.
std::string scanned_relation(const StreamCallView& scan) {
  const auto object = view_as<ObjectView>(*scan.arguments[0]);
  return object && scan.arguments[0]->type().is_relation() ? object->name : std::string();
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

// `R feed filter[...]`
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

/// Puts another operator on the same arguments in the place of a call.
TypedPtr with_operator(const TypedPtr& node, const StreamCallView& call, BoundOperator bound) {
  std::vector<TypedPtr> arguments(call.arguments.begin(), call.arguments.end());
  return node->replaced_by(make_stream_call(call.op, std::move(bound), std::move(arguments), node->place()),
                           std::nullopt);
}

// `sortby[...] head[n]`
void keep_first(const BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  // A heap of more tuples costs as much as the sort.
  constexpr std::int64_t kMost = std::int64_t{1} << 16U;
  if (!std::holds_alternative<TakesFirst>(bound.role)) return;
  const auto sort = call_with<SortsTuples>(*arguments[0]);
  const auto count = view_as<ConstantView>(*arguments[1]);
  if (!sort || !count || count->value == nullptr || count->value->type().name() != "int") return;
  const auto wanted = count->value->get<std::int64_t>();
  if (wanted < 0 || wanted > kMost) return;
  const auto& role = std::get<SortsTuples>(sort->bound.role);
  arguments[0] = with_operator(arguments[0], *sort, role.of_first(static_cast<std::size_t>(wanted)));
}

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

// `R feed S feed product filter[...]` and `R feed S feed symmjoin[...]`
void pair_by_hash(BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  if (const auto* pairs = std::get_if<PairsTuples>(&bound.role); pairs != nullptr && pairs->has_predicate) {
    if (const auto keys = join_keys_in(*arguments[2], pairs->left_count)) bound = pairs->with_equal(*keys);
    return;
  }
  if (!std::holds_alternative<SelectsElements>(bound.role)) return;
  const auto product = call_with<PairsTuples>(*arguments[0]);
  if (!product) return;
  const auto& pairs = std::get<PairsTuples>(product->bound.role);
  if (pairs.has_predicate) return;
  if (const auto keys = join_keys_in(*arguments[1], pairs.left_count))
    arguments[0] = with_operator(arguments[0], *product, pairs.with_equal(*keys));
}

}  // namespace

Status rewrite(BoundOperator& bound, std::vector<TypedPtr>& arguments, const RewriteContext& rewriting) {
  A3D_TRY(read_by_index(bound, arguments, rewriting));
  keep_first(bound, arguments);
  pair_by_hash(bound, arguments);
  return {};
}

std::optional<std::uint64_t> estimated_tuples(const TypedNode& node, ObjectSource& objects) {
  const auto scan = call_with<ScansRelation>(node);
  if (!scan) return std::nullopt;
  const std::string name = scanned_relation(*scan);
  if (name.empty()) return std::nullopt;
  const auto relation = objects.value_of(name);
  if (!relation) return std::nullopt;
  const auto count = relation->relation()->count();
  return count ? std::optional(static_cast<std::uint64_t>(*count)) : std::nullopt;
}

}  // namespace queries
