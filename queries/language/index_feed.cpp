#include "queries/language/index_feed.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/base/diagnostics.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

/// The condition with its operands evaluated; nothing if that failed: the filter will tell.
std::optional<IndexQuestion> question_of(const IndexChoice& choice, const Frame* frame, Context& context) {
  // What there is to note is noted by the filter.
  algebra3d::Diagnostics unheard;
  Context own{unheard, context.cancel, context.folder, context.memory};
  Result<Value> operand = choice.operand->evaluate_value(frame, own);
  if (!operand) return std::nullopt;
  IndexQuestion question{choice.use, std::move(operand).value(), std::nullopt};
  if (choice.limit == nullptr) return question;
  Result<Value> limit = choice.limit->evaluate_value(frame, own);
  if (!limit) return std::nullopt;
  question.limit = std::move(limit).value();
  return question;
}

/// Whether to fetch tuples by their ids: that takes some times as long for each as a scan does.
bool pays(std::uint64_t candidate_count, std::uint64_t tuple_count) {
  constexpr std::uint64_t kFetchCost = 4;
  return candidate_count * kFetchCost <= tuple_count;
}

/// The ids of the tuples to read; nothing if all tuples are to be read.
Result<std::optional<std::vector<TupleId>>> ids_to_read(const Relation& relation, const IndexChoice& choice,
                                                        const std::optional<IndexQuestion>& question,
                                                        ObjectSource& objects) {
  std::optional<std::vector<TupleId>> ids;
  if (!question) return ids;
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::int64_t count, relation.count());
  const auto tuple_count = static_cast<std::uint64_t>(count);
  // What is wrong with an index is no reason not to answer.
  const Result<Datum> index = objects.current_index(choice.index.name);
  if (!index) return ids;
  ALGEBRA3D_ASSIGN_OR_RETURN(ids, index_candidates(*index, choice.index.type, *question, tuple_count));
  if (ids && !pays(ids->size(), tuple_count)) ids.reset();
  return ids;
}

/// The tuples of a relation that the index finds, or all of them.
Result<TupleStreamPtr> found_tuples(Relation& relation, const IndexChoice& choice,
                                    const std::optional<IndexQuestion>& question, ObjectSource& objects) {
  ALGEBRA3D_ASSIGN_OR_RETURN(auto ids, ids_to_read(relation, choice, question, objects));
  return ids ? relation.select(*std::move(ids)) : relation.scan();
}

}  // namespace

IndexFeedNode::IndexFeedNode(TypeExpr stream, IndexChoice choice, TypedPtr relation, ObjectSource& objects,
                             SourcePlace place)
    : TypedNode(std::move(stream), std::move(place)),
      choice_(std::move(choice)),
      relation_(std::move(relation)),
      objects_(objects) {}

// The index is asked when the first tuple is wanted, so that it shows the same state as a scan.
Result<Datum> IndexFeedNode::evaluate(const Frame* frame, Context& context) const {
  ALGEBRA3D_ASSIGN_OR_RETURN(const Datum relation, relation_->evaluate(frame, context));
  auto self = std::static_pointer_cast<const IndexFeedNode>(shared_from_this());
  return Datum{make_stream([self = std::move(self), relation = relation.relation(), &context,
                            question = question_of(choice_, frame, context), tuples = TupleStreamPtr(),
                            step = 0U]() mutable -> Result<TuplePtr> {
    if (++step % 256 == 0) ALGEBRA3D_RETURN_IF_ERROR(context.check_cancelled());
    if (tuples == nullptr) {
      ALGEBRA3D_ASSIGN_OR_RETURN(tuples, found_tuples(*relation, self->choice_, question, self->objects_));
    }
    return tuples->next();
  })};
}

Result<std::uint64_t> IndexFeedNode::estimate(Context& context) const {
  ALGEBRA3D_ASSIGN_OR_RETURN(const Datum datum, relation_->evaluate(nullptr, context));
  const Relation& relation = *datum.relation();
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto ids,
                             ids_to_read(relation, choice_, question_of(choice_, nullptr, context), objects_));
  if (ids) return ids->size();
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::int64_t count, relation.count());
  return static_cast<std::uint64_t>(count);
}

std::string IndexFeedNode::text() const {
  return fmt::format("by the index {}", choice_.index.name);
}

}  // namespace queries
