#include "queries/language/column_pruning.h"

#include <algorithm>
#include <utility>

#include "queries/language/index_feed.h"
#include "queries/language/plan_views.h"

namespace queries {
namespace {

using ReadAttributes = std::vector<bool>;  // by attribute of a tuple

/// Finds the attributes of its parameters that the function of a tuple, or of a pair of tuples, reads.
class AttributeSearch {
 public:
  /// `read` is of the tuple, or of both: those of the second one follow `left_count` of the first.
  AttributeSearch(ReadAttributes& read, std::size_t left_count) : read_(read), left_count_(left_count) {}

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
    if (tuple->level == depth_) read_[tuple->index * left_count_ + use.index] = true;
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
  std::size_t left_count_;
  std::size_t depth_ = 0;
};

/// Adds the attributes that a function of a tuple, or of a pair of tuples, reads.
void add_attributes_of(const TypedNode& function, ReadAttributes& read, std::size_t left_count = 0) {
  if (const auto view = view_as<FunctionView>(function))
    AttributeSearch(read, left_count).search(view->body);
  else
    read.assign(read.size(), true);
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
  if (const auto* selection = std::get_if<SelectsByAttributes>(&role)) {
    for (const std::size_t index : selection->indices) read[index] = true;
    return read;
  }
  if (const auto* sort = std::get_if<SortsTuples>(&role)) {
    for (const SortKey& key : sort->order) read[key.attribute] = true;
    return read;
  }
  return std::nullopt;
}

TypedPtr reading(const TypedPtr& node, const ReadAttributes& read);

/// As `reading`, for a join.
TypedPtr reading_pairs(const TypedPtr& node, const StreamCallView& call, ReadAttributes read) {
  const auto& pairs = std::get<PairsTuples>(call.bound.role);
  std::vector<TypedPtr> arguments(call.arguments.begin(), call.arguments.end());
  if (pairs.has_predicate) add_attributes_of(*arguments[2], read, pairs.left_count);
  BoundOperator bound = pairs.of_attributes ? pairs.of_attributes(read) : call.bound;
  if (pairs.keys) read[pairs.keys->left] = read[pairs.left_count + pairs.keys->right] = true;
  const auto middle = read.begin() + static_cast<std::ptrdiff_t>(pairs.left_count);
  arguments[0] = reading(arguments[0], ReadAttributes(read.begin(), middle));
  arguments[1] = reading(arguments[1], ReadAttributes(middle, read.end()));
  return with_arguments(node, call, std::move(bound), std::move(arguments));
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
  if (std::holds_alternative<PairsTuples>(call->bound.role)) return reading_pairs(node, *call, read);
  if (!node->type().is_tuple_stream()) return node;
  const auto of_input = attributes_for(*call, read);
  if (!of_input) return node;
  std::vector<TypedPtr> arguments(call->arguments.begin(), call->arguments.end());
  arguments[0] = reading(arguments[0], *of_input);
  return with_arguments(node, *call, call->bound, std::move(arguments));
}

}  // namespace

std::vector<bool> attributes_read(const TypedNode& function, std::size_t count) {
  ReadAttributes read(count);
  add_attributes_of(function, read);
  return read;
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

}  // namespace queries
