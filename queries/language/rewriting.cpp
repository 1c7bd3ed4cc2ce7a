#include "queries/language/rewriting.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/index_condition.h"
#include "queries/language/index_feed.h"
#include "queries/streams/batch.h"
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

/// Where the value of an attribute is, if a condition with a constant holds; nothing if that is not known.
std::optional<AttributeBounds> bounds_of(const IndexCondition& condition, const TypeExpr& tuple) {
  const auto constant = view_as<ConstantView>(*condition.operand);
  if (!constant || constant->value == nullptr) return std::nullopt;
  const auto& attributes = tuple.attributes();
  const auto attribute = std::ranges::find(attributes, condition.attribute, &TypeExpr::Attribute::name);
  const std::string_view type = constant->value->type().name();
  if (attribute == attributes.end() || !attribute->type.is(type) || (type != "int" && type != "real"))
    return std::nullopt;
  AttributeBounds bounds{static_cast<std::size_t>(attribute - attributes.begin()), {}, {}};
  const bool is_equal = condition.use == IndexUse::equals;
  if (is_equal || condition.use == IndexUse::at_least) bounds.low = *constant->value;
  if (is_equal || condition.use == IndexUse::at_most) bounds.high = *constant->value;
  return bounds.low || bounds.high ? std::optional(std::move(bounds)) : std::nullopt;
}

TypedPtr with_operator(const TypedPtr& node, const StreamCallView& call, BoundOperator bound);

// `R feed filter[...]`: the least and greatest values of row groups [zone maps]
void leave_out_groups(const BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  if (!std::holds_alternative<SelectsElements>(bound.role)) return;
  const auto scan = call_with<ScansRelation>(*arguments[0]);
  const auto function = view_as<FunctionView>(*arguments[1]);
  if (!scan || !function) return;
  std::vector<AttributeBounds> bounds;
  for (const IndexCondition& condition : index_conditions(function->body))
    if (auto own = bounds_of(condition, arguments[0]->type().element())) bounds.push_back(*std::move(own));
  if (bounds.empty()) return;
  const auto& role = std::get<ScansRelation>(scan->bound.role);
  arguments[0] = with_operator(arguments[0], *scan, role.within(std::move(bounds)));
}

/// Puts another operator on the same arguments in the place of a call.
TypedPtr with_operator(const TypedPtr& node, const StreamCallView& call, BoundOperator bound) {
  std::vector<TypedPtr> arguments(call.arguments.begin(), call.arguments.end());
  return node->renewed(make_stream_call(call.op, std::move(bound), std::move(arguments), node->place()));
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

// `sortby[K] groupby[K; ...]` and `sort rdup`
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

using ReadAttributes = std::vector<bool>;  // by attribute of a tuple

/// Finds the attributes of its parameter that the function of a tuple reads.
class AttributeSearch {
 public:
  /// `read` is of the tuple.
  explicit AttributeSearch(ReadAttributes& read) : read_(read) {}

  void search(const TypedNode& node) {
    std::visit([&](const auto& view) { visit(view); }, node.view());
  }

 private:
  void visit(const ConstantView& /*constant*/) {}
  void visit(const ObjectView& /*object*/) {}
  void visit(const ParameterView& parameter) {
    if (parameter.level == depth_) read_.assign(read_.size(), true);
  }
  void visit(const AttributeView& use) {
    const auto tuple = view_as<ParameterView>(use.tuple);
    if (!tuple) return search(use.tuple);
    if (tuple->level == depth_ && tuple->index == 0) read_[use.index] = true;
  }
  void visit(const ConversionView& conversion) { search(conversion.argument); }
  void visit(const ValueCallView& call) { search_all(call.arguments); }
  void visit(const StreamCallView& call) { search_all(call.arguments); }
  void visit(const ListView& list) { search_all(list.elements); }
  void visit(const FunctionView& function) {
    ++depth_;
    search(function.body);
    --depth_;
  }
  // A node without a view may read all attributes.
  void visit(const std::monostate& /*unknown*/) { read_.assign(read_.size(), true); }
  void search_all(std::span<const TypedPtr> nodes) {
    for (const TypedPtr& node : nodes) search(*node);
  }

  ReadAttributes& read_;
  std::size_t depth_ = 0;
};

/// Adds the attributes that a function of a tuple reads.
void add_attributes_of(const TypedNode& function, ReadAttributes& read) {
  if (const auto view = view_as<FunctionView>(function))
    AttributeSearch(read).search(view->body);
  else
    read.assign(read.size(), true);
}

std::size_t attribute_count(const TypedNode& stream) {
  return stream.type().element().attributes().size();
}

/// The attributes of the old tuples that new ones are made of, if those in `read` are read of these: all functions are
/// called.
ReadAttributes attributes_for(const MakesTuples& making, const ReadAttributes& read,
                              std::span<const TypedPtr> arguments) {
  ReadAttributes of_input(attribute_count(*arguments[0]));
  for (std::size_t index = 0; index < read.size(); ++index)
    if (const AttributeSource& source = making.sources[index]; read[index] && !source.is_made)
      of_input[source.index] = true;
  for (const TypedPtr& argument : arguments.subspan(1))
    if (const auto list = view_as<ListView>(*argument))
      for (const TypedPtr& function : list->elements) add_attributes_of(*function, of_input);
  return of_input;
}

/// The attributes that the input of an operator on a stream needs to have, if those in `read` are read of its result;
/// nothing if that is not known.
std::optional<ReadAttributes> attributes_for(const StreamCallView& call, ReadAttributes read) {
  const OperatorRole& role = call.bound.role;
  if (const auto* making = std::get_if<MakesTuples>(&role)) return attributes_for(*making, read, call.arguments);
  if (std::holds_alternative<TakesFirst>(role)) return read;
  if (std::holds_alternative<SelectsElements>(role)) {
    add_attributes_of(*call.arguments[1], read);
    return read;
  }
  if (const auto* sort = std::get_if<SortsTuples>(&role)) {
    for (const SortKey& key : sort->order) read[key.attribute] = true;
    return read;
  }
  return std::nullopt;
}

/// A plan with the tuples of `node`, of which only some attributes are read: scans below it, as far down as operators
/// have roles, leave the others out.
TypedPtr reading(const TypedPtr& node, const ReadAttributes& read) {
  if (const auto* index_feed = dynamic_cast<const IndexFeedNode*>(node->unmeasured().get()))
    return node->renewed(index_feed->reading(read));
  const auto call = view_as<StreamCallView>(*node);
  if (!call) return node;
  if (const auto* scan = std::get_if<ScansRelation>(&call->bound.role))
    return with_operator(node, *call, scan->of_attributes(read));
  if (!node->type().is_tuple_stream()) return node;
  const auto of_input = attributes_for(*call, read);
  if (!of_input) return node;
  std::vector<TypedPtr> arguments(call->arguments.begin(), call->arguments.end());
  arguments[0] = reading(arguments[0], *of_input);
  return node->renewed(make_stream_call(call->op, call->bound, std::move(arguments), node->place()));
}

void read_needed_attributes(BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  if (const auto* scan = std::get_if<ScansRelation>(&bound.role)) {
    const std::size_t count = bound.type.element().attributes().size();
    bound = BoundOperator(scan->of_attributes(ReadAttributes(count, true)));
    return;
  }
  if (arguments.empty() || !arguments[0]->type().is_tuple_stream()) return;
  ReadAttributes read(attribute_count(*arguments[0]));
  if (const auto* uses = std::get_if<UsesAttributes>(&bound.role))
    for (const std::size_t index : uses->indices) read[index] = true;
  else if (const auto* aggregate = std::get_if<AggregatesAttribute>(&bound.role))
    read[aggregate->attribute] = true;
  else if (const auto* making = std::get_if<MakesTuples>(&bound.role))
    read = attributes_for(*making, ReadAttributes(making->sources.size(), true), arguments);
  else if (!std::holds_alternative<CountsElements>(bound.role))
    return;
  arguments[0] = reading(arguments[0], read);
}

// `R feed count`: the relation knows the number.
void count_without_reading(BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  if (!std::holds_alternative<CountsElements>(bound.role)) return;
  TypedPtr input = arguments[0];
  while (const auto call = call_with<MakesTuples>(*input)) {
    if (call->arguments.size() > 1 && std::ranges::any_of(call->arguments, [](const TypedPtr& each) {
          const auto list = view_as<ListView>(*each);
          return list && !list->elements.empty();
        }))
      return;
    input = call->arguments[0];
  }
  const auto scan = call_with<ScansRelation>(*input);
  if (!scan) return;
  arguments[0] = scan->arguments[0];
  bound.how = "the number that the relation keeps";
}

}  // namespace

Status rewrite(BoundOperator& bound, std::vector<TypedPtr>& arguments, const RewriteContext& rewriting) {
  A3D_TRY(read_by_index(bound, arguments, rewriting));
  leave_out_groups(bound, arguments);
  keep_first(bound, arguments);
  pair_by_hash(bound, arguments);
  group_by_hash(bound, arguments);
  count_without_reading(bound, arguments);
  read_needed_attributes(bound, arguments);
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
