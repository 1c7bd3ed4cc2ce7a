#pragma once

#include <memory>
#include <vector>

#include "queries/store/detail/group_writer.h"

namespace queries {

/// A tuple of a row group, with its chunks kept for the next one. Errors: database_corrupt.
Result<TuplePtr> tuple_of_group(Database& database, const RelationLayout& layout, const RowGroup& group,
                                std::size_t row);

/// Many new tuples of a relation that are written as row groups. Until `finish` nobody sees them: so they may be made
/// by a stream that reads the relation.
class RelationFilling {
 public:
  RelationFilling(Database& database, std::shared_ptr<const RelationLayout> layout, TupleId first)
      : database_(database), layout_(layout), first_(first), next_(first), writer_(database, std::move(layout)) {}

  Status add(const Tuple& tuple) { return writer_.add(next_++, tuple); }
  Status add(const Batch& batch);
  /// Adds all tuples of a stream.
  Status add_all(TupleStream& tuples, const algebra3d::Context& context);
  /// Puts the row groups into the relation, whose counts are those of `entry`. The last tuples, if they are too few for
  /// a group, are left: they are to be inserted one by one.
  Result<std::vector<Tuple>> finish(CatalogueEntry& entry);
  /// The row groups that `finish` has put into the relation.
  const std::vector<RowGroup>& groups() const { return groups_; }

 private:
  Database& database_;
  std::shared_ptr<const RelationLayout> layout_;
  TupleId first_, next_;
  GroupWriter writer_;
  std::vector<RowGroup> groups_;
};

}  // namespace queries
