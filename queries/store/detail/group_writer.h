#pragma once

#include <memory>
#include <vector>

#include "queries/store/detail/chunk_builder.h"
#include "queries/store/detail/database.h"
#include "queries/streams/batch.h"

namespace queries {

/// Writes tuples as row groups. A group ends where it has enough tuples or bytes. The groups are in the file at once,
/// and in the list of their relation when the caller has put them there.
class GroupWriter {
 public:
  GroupWriter(Database& database, std::shared_ptr<const RelationLayout> layout);

  /// Adds a tuple; ids ascend. Errors: those of ChunkBuilder::add and of writing.
  Status add(TupleId id, const Tuple& tuple);
  /// Adds tuples whose ids follow one another.
  Status add(TupleId first_id, const Batch& batch);
  /// Ends the group that is being filled.
  Status close();

  /// The tuples of the group that is being filled.
  std::size_t pending_count() const { return ids_.size(); }
  Result<std::vector<Tuple>> pending() const;
  void drop_pending();
  /// The groups that were written since the last call.
  std::vector<RowGroup> take_groups() { return std::exchange(groups_, {}); }

 private:
  bool is_full() const;

  Database& database_;
  std::shared_ptr<const RelationLayout> layout_;
  std::vector<TupleId> ids_;
  std::vector<ChunkBuilder> builders_;  // by attribute
  std::vector<RowGroup> groups_;
};

}  // namespace queries
