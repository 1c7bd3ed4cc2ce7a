#include "queries/language/index_feed.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

#include "base/diagnostics.h"
#include "base/propagate.h"
#include "queries/streams/index_object.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

/// The condition with its operands evaluated; nothing if that failed: the filter will report it.
std::optional<IndexQuestion> question_of(const IndexChoice& choice, const Frame* frame, Context& context) {
  // Notes are left to the filter, which evaluates its operands again.
  algebra3d::Diagnostics unheard;
  Context own = context.with(unheard);
  const Frame in_filter{{}, frame};
  Result<Value> operand = choice.operand->evaluate_value(&in_filter, own);
  if (!operand) return std::nullopt;
  IndexQuestion question{choice.use, std::move(operand).value(), std::nullopt};
  if (choice.limit == nullptr) return question;
  Result<Value> limit = choice.limit->evaluate_value(&in_filter, own);
  if (!limit) return std::nullopt;
  question.limit = std::move(limit).value();
  return question;
}

/// Whether to fetch tuples by their ids: that takes some times as long for each as a scan does.
bool pays(std::uint64_t candidate_count, std::uint64_t tuple_count) {
  constexpr std::uint64_t kFetchCost = 4;
  return candidate_count * kFetchCost <= tuple_count;
}

/// The smaller, the fewer tuples a condition is likely to leave.
int rank(IndexUse use) {
  switch (use) {
    case IndexUse::equals:
      return 0;
    case IndexUse::between:
      return 2;
    case IndexUse::at_least:
    case IndexUse::at_most:
      return 3;
    default:
      return 1;
  }
}

/// What an index finds, and its name.
struct Found {
  IndexCandidates tuples;
  std::string index;
};

/// The tuples that the first index finds that pays; nothing if all tuples are to be read.
Result<std::optional<Found>> found_by_index(const Relation& relation, const std::vector<IndexChoice>& choices,
                                            const std::vector<std::optional<IndexQuestion>>& questions,
                                            ObjectSource& objects) {
  A3D_ASSIGN(const std::int64_t count, relation.count());
  const auto tuple_count = static_cast<std::uint64_t>(count);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (!questions[i]) continue;
    // An index that cannot be read is passed over: the relation is there.
    const Result<Datum> index = objects.current_index(choices[i].index.name);
    if (!index) continue;
    A3D_ASSIGN(auto tuples, index_candidates(*index, choices[i].index.type, *questions[i], tuple_count));
    if (tuples && pays(tuples->ids.size(), tuple_count))
      return std::optional(Found{*std::move(tuples), choices[i].index.name});
  }
  return std::optional<Found>();
}

/// The tuples of a relation that an index has found. Each must be as the index says: the filter would pass over one
/// that is not.
Result<TupleStreamPtr> selected(Relation& relation, IndexCandidates found) {
  A3D_ASSIGN(TupleStreamPtr tuples, relation.select(std::exchange(found.ids, {})));
  const auto& attributes = relation.tuple_type().attributes();
  const auto attribute = static_cast<std::size_t>(
      std::ranges::find(attributes, found.attribute, &TypeExpr::Attribute::name) - attributes.begin());
  if (attribute == attributes.size())
    return Error{ErrorCode::internal, "{}: the relation has no attribute '{}'", relation.name(), found.attribute};
  return make_stream(
      [tuples = std::move(tuples), found = std::move(found), attribute, name = relation.name()]() -> Result<TuplePtr> {
        A3D_ASSIGN(TuplePtr tuple, tuples->next());
        if (tuple == nullptr || fits(found, tuple->attributes[attribute])) return tuple;
        return index_disagrees(name, found.attribute, tuple->id, true);
      });
}

/// A search in a relation by its indexes, and the attributes that it reads.
struct IndexReading {
  RelationPtr relation;
  std::vector<IndexChoice> choices;
  std::vector<std::optional<IndexQuestion>> questions;
  std::vector<bool> read;  // attributes
};

/// The tuples of a relation that an index finds, or all of them. The index is asked when the first tuple is wanted, so
/// that it shows the same state as a scan.
class IndexedTuples final : public TupleStream {
 public:
  IndexedTuples(IndexReading reading, ObjectSource& objects, const Context& context)
      : reading_(std::move(reading)), objects_(objects), context_(context) {}

  Result<TuplePtr> next() override {
    if (++step_ % 256 == 0) A3D_TRY(context_.check_cancelled());
    if (tuples_ == nullptr) A3D_TRY(open());
    return tuples_->next();
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    A3D_TRY(context_.check_cancelled());
    if (tuples_ == nullptr) A3D_TRY(open());
    if (tuples_->has_batches()) return tuples_->next_batch(most);
    if (!found_) found_.emplace(reading_.relation->tuple_type(), reading_.read);
    return found_->next(*tuples_, most);
  }

 private:
  Status open() {
    A3D_ASSIGN(auto found, found_by_index(*reading_.relation, reading_.choices, reading_.questions, objects_));
    A3D_ASSIGN(tuples_, found ? selected(*reading_.relation, std::move(found->tuples))
                              : reading_.relation->scan_columns(reading_.read, {}));
    return {};
  }

  IndexReading reading_;
  ObjectSource& objects_;
  const Context& context_;
  TupleStreamPtr tuples_;
  std::optional<BatchOfTuples> found_;
  std::uint32_t step_ = 0;
};

std::vector<std::optional<IndexQuestion>> questions_of(const std::vector<IndexChoice>& choices, const Frame* frame,
                                                       Context& context) {
  std::vector<std::optional<IndexQuestion>> questions;
  questions.reserve(choices.size());
  for (const IndexChoice& choice : choices) questions.push_back(question_of(choice, frame, context));
  return questions;
}

}  // namespace

IndexFeedNode::IndexFeedNode(TypeExpr stream, std::vector<IndexChoice> choices, TypedPtr relation,
                             ObjectSource& objects, SourcePlace place)
    : TypedNode(std::move(stream), std::move(place)),
      choices_(std::move(choices)),
      relation_(std::move(relation)),
      objects_(objects),
      read_(this->type().element().attributes().size(), true) {
  std::ranges::stable_sort(choices_, {}, [](const IndexChoice& choice) { return rank(choice.use); });
  std::vector<std::string> names;
  for (const IndexChoice& choice : choices_)
    if (std::ranges::find(names, choice.index.name) == names.end()) names.push_back(choice.index.name);
  how_ = fmt::format("by the index {}", fmt::join(names, " or "));
}

std::shared_ptr<IndexFeedNode> IndexFeedNode::reading(std::vector<bool> read) const {
  auto node = std::make_shared<IndexFeedNode>(type(), choices_, relation_, objects_, place());
  node->read_ = std::move(read);
  node->how_ = how_;
  return node;
}

Result<Datum> IndexFeedNode::evaluate(const Frame* frame, Context& context) const {
  A3D_ASSIGN(const Datum relation, relation_->evaluate(frame, context));
  return Datum{TupleStreamPtr(std::make_shared<IndexedTuples>(
      IndexReading{relation.relation(), choices_, questions_of(choices_, frame, context), read_}, objects_, context))};
}

std::optional<std::uint64_t> IndexFeedNode::describe_plan(Context& context) {
  const auto datum = relation_->evaluate(nullptr, context);
  if (!datum) return std::nullopt;
  const Relation& relation = *datum->relation();
  const auto found = found_by_index(relation, choices_, questions_of(choices_, nullptr, context), objects_);
  const auto count = relation.count();
  if (!found || !count) return std::nullopt;
  if (*found) {
    how_ = fmt::format("by the index {}", (*found)->index);
    return (*found)->tuples.ids.size();
  }
  how_ = fmt::format("a scan: not {}, which would find too many tuples or cannot decide", how_);
  return static_cast<std::uint64_t>(*count);
}

}  // namespace queries
