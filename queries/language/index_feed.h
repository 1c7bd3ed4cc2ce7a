#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "queries/language/typed_tree.h"
#include "queries/streams/index_candidates.h"

namespace queries {

/// An index on an attribute that a condition limits, with the operands of the condition.
struct IndexChoice {
  ObjectSource::IndexName index;
  IndexUse use;
  TypedPtr operand;  ///< in the filter's function, whose parameters it does not use
  TypedPtr limit;    ///< of IndexUse::is_near and between; else null
};
/// The tuples that any of some indexes finds.
using IndexSearch = std::vector<IndexChoice>;

/// The tuples of a relation that may fulfil a condition, found by an index: a node in place of `feed` before a filter,
/// which still asks the whole condition of each. Of several searches those are made first that are likely to find few
/// tuples, and the first is used that pays. All tuples come, as by `feed`, if none pays or can decide. The order is
/// that of `feed`, and so is the state of the relation that is shown.
class IndexFeedNode final : public TypedNode {
 public:
  IndexFeedNode(TypeExpr stream, std::vector<IndexSearch> searches, TypedPtr relation, ObjectSource& objects,
                SourcePlace place);
  Result<Datum> evaluate(const Frame* frame, Context& context) const override;

  /// The expression of the relation.
  const TypedPtr& relation() const { return relation_; }
  /// A node that reads only some attributes, by their places.
  std::shared_ptr<IndexFeedNode> reading(std::vector<bool> read) const;

  /// The indexes that it may read by, or, after `describe_plan`, the way in which it would have read then.
  std::string how() const override { return how_; }
  /// Finds the way in which it would read now, and the number of tuples that it would give; nothing if the index cannot
  /// be read. To be called before the node is shared. Domain: outside of functions.
  std::optional<std::uint64_t> describe_plan(Context& context);
  /// That number.
  std::optional<std::uint64_t> estimate() const { return estimate_; }
  /// The relation that it would have scanned then; null if it would have read by an index.
  const TypedNode* scanned() const { return is_scan_ ? relation_.get() : nullptr; }

 private:
  std::vector<IndexSearch> searches_;
  TypedPtr relation_;
  ObjectSource& objects_;
  std::vector<bool> read_;
  std::string how_;
  std::optional<std::uint64_t> estimate_;
  bool is_scan_ = false;
};

}  // namespace queries
