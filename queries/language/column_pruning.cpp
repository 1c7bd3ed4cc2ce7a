#include "queries/language/column_pruning.h"

#include <algorithm>
#include <utility>

#include "queries/language/index_feed.h"
#include "queries/language/late_reading.h"
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
  if (std::holds_alternative<TakesFirst>(role) || std::holds_alternative<TakesLast>(role)) return read;
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

/// As `reading`, for tuples that are changed: they have the attributes of their input, of an update twice, and the id.
TypedPtr reading_changes(const TypedPtr& node, const StreamCallView& call, const ReadAttributes& read) {
  if (std::get<ChangesTuples>(call.bound.role).of_own) return node;  // all attributes are compared
  std::vector<TypedPtr> arguments(call.arguments.begin(), call.arguments.end());
  ReadAttributes of_input(attribute_count(*arguments[0]));
  for (std::size_t index = 0; index + 1 < read.size(); ++index)
    if (read[index]) of_input[index % of_input.size()] = true;
  if (arguments.size() > 2)
    if (const auto list = view_as<ListView>(*arguments[2]))
      for (const TypedPtr& function : list->elements) add_attributes_of(*function, of_input);
  arguments[0] = reading(arguments[0], of_input);
  return with_arguments(node, call, call.bound, std::move(arguments));
}

/// As `reading`, for streams that a function gives, one for each tuple of another stream.
TypedPtr reading_chain(const TypedPtr& node, const StreamCallView& call, const ReadAttributes& read) {
  std::vector<TypedPtr> arguments(call.arguments.begin(), call.arguments.end());
  ReadAttributes of_outer(attribute_count(*arguments[0]));
  add_attributes_of(*arguments[1], of_outer);
  arguments[0] = reading(arguments[0], of_outer);
  if (const auto function = view_as<FunctionView>(*arguments[1]))
    arguments[1] = make_function(arguments[1]->type(), reading(function->body.shared_from_this(), read),
                                 function->written, function->height, arguments[1]->place());
  return with_arguments(node, call, call.bound, std::move(arguments));
}

/// Whether an operator keeps few tuples, when it has read all of its input.
bool keeps_few(const StreamCallView& call) {
  // More are as well read by a scan.
  constexpr std::int64_t kMost = std::int64_t{1} << 16U;
  if (const auto* sort = std::get_if<SortsTuples>(&call.bound.role)) return sort->most.has_value();
  if (!std::holds_alternative<TakesLast>(call.bound.role)) return false;
  const auto count = view_as<ConstantView>(*call.arguments[1]);
  return count && count->value != nullptr && count->value->type().name() == "int" &&
         count->value->get<std::int64_t>() <= kMost;
}

/// The expression of the stored relation of which a plan selects tuples, from a scan of it or, if `by_index`, by its
/// indexes; null if it is another plan.
TypedPtr relation_of(TypedPtr node, bool by_index) {
  while (true) {
    if (const auto* index_feed = dynamic_cast<const IndexFeedNode*>(node->unmeasured().get()))
      return by_index ? index_feed->relation() : nullptr;
    const auto call = view_as<StreamCallView>(*node);
    if (!call || !node->type().is_tuple_stream()) return nullptr;
    const OperatorRole& role = call->bound.role;
    if (std::holds_alternative<ScansRelation>(role))
      return scanned_relation(*call).empty() ? nullptr : call->arguments[0];
    const bool selects = std::holds_alternative<SelectsElements>(role) || std::holds_alternative<TakesFirst>(role) ||
                         std::holds_alternative<TakesLast>(role) || std::holds_alternative<SortsTuples>(role);
    if (!selects) return nullptr;
    node = call->arguments[0];
  }
}

/// The attributes that the operators down to the scan of a relation read by themselves.
ReadAttributes attributes_below(const StreamCallView& call, ReadAttributes read) {
  read = attributes_for(call, std::move(read)).value_or(ReadAttributes(attribute_count(*call.arguments[0]), true));
  const auto below = view_as<StreamCallView>(*call.arguments[0]);
  return below && !std::holds_alternative<ScansRelation>(below->bound.role) ? attributes_below(*below, std::move(read))
                                                                            : read;
}

/// Reads what operators that keep few tuples do not need by the ids of those; null if that is nothing, or does not
/// help.
TypedPtr reading_late(const TypedPtr& node, const StreamCallView& call, const ReadAttributes& read) {
  if (!keeps_few(call)) return nullptr;
  const TypedPtr relation = relation_of(node, false);
  if (relation == nullptr) return nullptr;
  const ReadAttributes needed = attributes_below(call, ReadAttributes(read.size()));
  bool has_more = false;
  for (std::size_t index = 0; index < read.size(); ++index) has_more = has_more || (read[index] && !needed[index]);
  if (!has_more) return nullptr;
  BoundOperator bound = call.bound;
  bound.how += (bound.how.empty() ? "" : ", ") + std::string("then reads by ids");
  std::vector<TypedPtr> arguments(call.arguments.begin(), call.arguments.end());
  arguments[0] = reading(arguments[0], *attributes_for(call, ReadAttributes(read.size())));
  return std::make_shared<LateReadingNode>(with_arguments(node, call, std::move(bound), std::move(arguments)), relation,
                                           read);
}

/// A plan with the tuples of `node`, of which only some attributes are read: scans below it, as far down as operators
/// have roles, leave the others out.
TypedPtr reading(const TypedPtr& node, const ReadAttributes& read) {
  if (const auto* index_feed = dynamic_cast<const IndexFeedNode*>(node->unmeasured().get()))
    return node->renewed(index_feed->reading(read));
  if (const auto* late = dynamic_cast<const LateReadingNode*>(node.get())) return late->reading(read);
  const auto call = view_as<StreamCallView>(*node);
  if (!call) return node;
  if (TypedPtr late = reading_late(node, *call, read)) return late;
  if (const auto* scan = std::get_if<ScansRelation>(&call->bound.role))
    return with_operator(node, *call, scan->of_attributes(read));
  if (const auto* search = std::get_if<FindsTuples>(&call->bound.role))
    return with_operator(node, *call, search->of_attributes(read));
  if (std::holds_alternative<ChangesTuples>(call->bound.role)) return reading_changes(node, *call, read);
  if (std::holds_alternative<ChainsStreams>(call->bound.role)) return reading_chain(node, *call, read);
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

void take_own_tuples(BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  const auto* change = std::get_if<ChangesTuples>(&bound.role);
  if (change == nullptr || !change->of_own) return;
  const TypedPtr origin = relation_of(arguments[0], true);
  const auto from = origin != nullptr ? view_as<ObjectView>(*origin) : std::nullopt;
  const auto changed = view_as<ObjectView>(*arguments[1]);
  if (!from || !changed || from->name != changed->name) return;
  bound = BoundOperator(change->of_own());
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
  else if (std::holds_alternative<CollectsTuples>(bound.role))
    read.assign(read.size(), true);
  else if (!std::holds_alternative<CountsElements>(bound.role))
    return;
  arguments[0] = reading(arguments[0], read);
}

}  // namespace queries
