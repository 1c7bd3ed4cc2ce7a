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
#include "queries/streams/listed_tuples.h"
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

/// The smaller, the fewer tuples a search is likely to find.
int rank_of(const IndexSearch& search) {
  int result = static_cast<int>(search.size()) - 1;
  for (const IndexChoice& choice : search) result = std::max(result, rank(choice.use));
  return result;
}

/// "R_K and R_W"
std::string names_of(const IndexSearch& search) {
  std::vector<std::string> names;
  for (const IndexChoice& choice : search)
    if (std::ranges::find(names, choice.index.name) == names.end()) names.push_back(choice.index.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

/// The questions of a search: nothing for those whose operands cannot be evaluated.
using IndexQuestions = std::vector<std::optional<IndexQuestion>>;

/// The result of a search: the tuples of each index, and all their ids.
struct Found {
  std::vector<IndexCandidates> by_index;
  std::vector<TupleId> ids;  // ascending
  std::string names;
};

/// Asks the indexes of a search; nothing if one of them cannot decide.
Result<std::optional<Found>> found_by(const IndexSearch& search, const IndexQuestions& questions,
                                      std::uint64_t tuple_count, ObjectSource& objects) {
  Found found;
  for (std::size_t i = 0; i < search.size(); ++i) {
    if (!questions[i]) return std::optional<Found>();
    // An index that cannot be read is passed over: the relation is there.
    const Result<Datum> index = objects.current_index(search[i].index.name);
    if (!index) return std::optional<Found>();
    A3D_ASSIGN(auto tuples, index_candidates(*index, search[i].index.type, *questions[i], tuple_count));
    if (!tuples) return std::optional<Found>();
    found.ids.insert(found.ids.end(), tuples->ids.begin(), tuples->ids.end());
    tuples->ids = {};
    found.by_index.push_back(*std::move(tuples));
  }
  if (search.size() > 1) {
    std::ranges::sort(found.ids);
    found.ids.erase(std::unique(found.ids.begin(), found.ids.end()), found.ids.end());
  }
  found.names = names_of(search);
  return std::optional(std::move(found));
}

/// The tuples that the first search finds that pays; nothing if all tuples are to be read.
Result<std::optional<Found>> found_by_index(const Relation& relation, const std::vector<IndexSearch>& searches,
                                            const std::vector<IndexQuestions>& questions, ObjectSource& objects) {
  A3D_ASSIGN(const std::int64_t count, relation.count());
  const auto tuple_count = static_cast<std::uint64_t>(count);
  for (std::size_t i = 0; i < searches.size(); ++i) {
    A3D_ASSIGN(auto found, found_by(searches[i], questions[i], tuple_count, objects));
    if (found && pays(found->ids.size(), tuple_count)) return found;
  }
  return std::optional<Found>();
}

/// The tuples of a relation that indexes have found, with some of their attributes. Each must be as one of the indexes
/// says: the filter would pass over one that is not.
Result<TupleStreamPtr> selected(const RelationPtr& relation, Found found, std::vector<bool> read,
                                const Context& context) {
  TupleList list{std::exchange(found.ids, {}), std::move(read), {}, {}};
  std::vector<std::size_t> indices;
  for (const IndexCandidates& each : found.by_index) {
    const auto& attributes = relation->tuple_type().attributes();
    const auto attribute = std::ranges::find(attributes, each.attribute, &TypeExpr::Attribute::name);
    if (attribute == attributes.end())
      return Error{ErrorCode::internal, "{}: the relation has no attribute '{}'", relation->name(), each.attribute};
    indices.push_back(static_cast<std::size_t>(attribute - attributes.begin()));
    if (each.window) list.read[indices.back()] = true;
  }
  const bool are_looked_at =
      std::ranges::all_of(found.by_index, [](const IndexCandidates& each) { return each.window.has_value(); });
  list.found_wrong = [name = relation->name(), attribute = found.by_index.front().attribute](TupleId id,
                                                                                             bool has_tuple) {
    return Status(index_disagrees(name, attribute, id, has_tuple));
  };
  if (are_looked_at)
    list.fits = [by_index = std::move(found.by_index), indices = std::move(indices)](const Batch& batch,
                                                                                     std::size_t row) {
      for (std::size_t i = 0; i < by_index.size(); ++i)
        if (fits(by_index[i], batch.columns[indices[i]]->value(row))) return true;
      return false;
    };
  return listed_tuples(relation, std::move(list), context);
}

/// A search in a relation by its indexes, and the attributes that it reads.
struct IndexReading {
  RelationPtr relation;
  std::vector<IndexSearch> searches;
  std::vector<IndexQuestions> questions;
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
    return batches_->next(most);
  }

 private:
  Status open() {
    A3D_ASSIGN(auto found, found_by_index(*reading_.relation, reading_.searches, reading_.questions, objects_));
    A3D_ASSIGN(tuples_, found ? selected(reading_.relation, *std::move(found), reading_.read, context_)
                              : reading_.relation->scan_columns(reading_.read, {}));
    batches_.emplace(*tuples_, reading_.read);
    return {};
  }

  IndexReading reading_;
  ObjectSource& objects_;
  const Context& context_;
  TupleStreamPtr tuples_;
  std::optional<BatchReader> batches_;  // of the tuples
  std::uint32_t step_ = 0;
};

std::vector<IndexQuestions> questions_of(const std::vector<IndexSearch>& searches, const Frame* frame,
                                         Context& context) {
  std::vector<IndexQuestions> questions(searches.size());
  for (std::size_t i = 0; i < searches.size(); ++i)
    for (const IndexChoice& choice : searches[i]) questions[i].push_back(question_of(choice, frame, context));
  return questions;
}

}  // namespace

IndexFeedNode::IndexFeedNode(TypeExpr stream, std::vector<IndexSearch> searches, TypedPtr relation,
                             ObjectSource& objects, SourcePlace place)
    : TypedNode(std::move(stream), std::move(place)),
      searches_(std::move(searches)),
      relation_(std::move(relation)),
      objects_(objects),
      read_(this->type().element().attributes().size(), true) {
  std::ranges::stable_sort(searches_, {}, rank_of);
  std::vector<std::string> names;
  for (const IndexSearch& search : searches_)
    if (std::string each = names_of(search); std::ranges::find(names, each) == names.end()) names.push_back(each);
  how_ = fmt::format("by the index {}", fmt::join(names, " or "));
}

std::shared_ptr<IndexFeedNode> IndexFeedNode::reading(std::vector<bool> read) const {
  auto node = std::make_shared<IndexFeedNode>(type(), searches_, relation_, objects_, place());
  node->read_ = std::move(read);
  node->how_ = how_;
  node->estimate_ = estimate_;
  node->is_scan_ = is_scan_;
  return node;
}

Result<Datum> IndexFeedNode::evaluate(const Frame* frame, Context& context) const {
  A3D_ASSIGN(const Datum relation, relation_->evaluate(frame, context));
  return Datum{TupleStreamPtr(std::make_shared<IndexedTuples>(
      IndexReading{relation.relation(), searches_, questions_of(searches_, frame, context), read_}, objects_,
      context))};
}

std::optional<std::uint64_t> IndexFeedNode::describe_plan(Context& context) {
  const auto datum = relation_->evaluate(nullptr, context);
  if (!datum) return std::nullopt;
  const Relation& relation = *datum->relation();
  const auto found = found_by_index(relation, searches_, questions_of(searches_, nullptr, context), objects_);
  const auto count = relation.count();
  if (!found || !count) return std::nullopt;
  if (*found) {
    how_ = fmt::format("by the index {}", (*found)->names);
    return estimate_ = (*found)->ids.size();
  }
  how_ = fmt::format("a scan: not {}, which would find too many tuples or cannot decide", how_);
  is_scan_ = true;
  return estimate_ = static_cast<std::uint64_t>(*count);
}

}  // namespace queries
