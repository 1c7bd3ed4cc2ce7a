#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "queries/language/typed_tree.h"
#include "queries/streams/index_candidates.h"

namespace queries {

/// An index on an attribute that a condition limits, with the operands of the condition.
struct IndexChoice {
  ObjectSource::IndexName index;
  IndexUse use;
  TypedPtr operand;  ///< checked outside of the filter's function
  TypedPtr limit;    ///< of IndexUse::is_near and between; else null
};

/// The way in which an IndexFeedNode would read now.
struct IndexFeedPlan {
  std::uint64_t tuple_count;  ///< that it would give
  std::string text;           ///< how, for people
};

/// The tuples of a relation that may fulfil a condition, found by an index: a node in place of `feed` before a filter,
/// which still asks the whole condition of each. Of several indexes those are asked first that are likely to find few
/// tuples, and the first is used that pays. All tuples come, as by `feed`, if none pays or can decide. The order is
/// that of `feed`, and so is the state of the relation that is shown.
class IndexFeedNode final : public TypedNode {
 public:
  IndexFeedNode(TypeExpr stream, std::vector<IndexChoice> choices, TypedPtr relation, ObjectSource& objects,
                SourcePlace place);
  Result<Datum> evaluate(const Frame* frame, Context& context) const override;

  /// Domain: outside of functions. Errors: those of reading the index.
  Result<IndexFeedPlan> plan(Context& context) const;
  /// The indexes that it may read by, for people.
  std::string text() const;

 private:
  std::vector<IndexChoice> choices_;
  TypedPtr relation_;
  ObjectSource& objects_;
};

}  // namespace queries
