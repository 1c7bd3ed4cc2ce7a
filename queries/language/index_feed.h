#pragma once

#include <cstdint>
#include <string>

#include "queries/language/typed_tree.h"
#include "queries/streams/index_candidates.h"

namespace queries {

/// An index on an attribute that a condition limits, with the operands of the condition.
struct IndexChoice {
  ObjectSource::IndexName index;
  IndexUse use;
  TypedPtr operand;  ///< checked outside of the filter's function
  TypedPtr limit;    ///< of IndexUse::is_near; else null
};

/// The tuples of a relation that may fulfil a condition, found by an index: a node in place of `feed` before a filter,
/// which still asks the whole condition of each. All tuples come, as by `feed`, if the index does not pay or cannot
/// tell. The order is that of `feed`, and so is the state of the relation that is shown.
class IndexFeedNode final : public TypedNode {
 public:
  IndexFeedNode(TypeExpr stream, IndexChoice choice, TypedPtr relation, ObjectSource& objects, SourcePlace place);
  Result<Datum> evaluate(const Frame* frame, Context& context) const override;

  /// The number of tuples that it would give now, outside of functions. Errors: those of reading the index.
  Result<std::uint64_t> estimate(Context& context) const;
  /// What it does, for people.
  std::string text() const;

 private:
  IndexChoice choice_;
  TypedPtr relation_;
  ObjectSource& objects_;
};

}  // namespace queries
