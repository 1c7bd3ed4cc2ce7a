#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "queries/store/detail/database.h"
#include "queries/streams/batch.h"

namespace queries {

/// Changes of many tuples of a relation that stand in row groups: tuples that go are marked as dead, and of those that
/// are changed the chunks of the changed attributes are written anew. Indexes follow. Part of a change of the database
/// (Database::change).
class GroupEdits {
 public:
  /// `entry`: of the relation; its number of tuples and its checksum follow.
  GroupEdits(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout, CatalogueEntry& entry);

  /// Erases those of the tuples that stand in row groups. The ids of the others.
  Result<std::vector<TupleId>> erase(std::span<const TupleId> ids, const algebra3d::Context& context);

  /// Gives tuples new values of some attributes. `values` has a tuple of these for each id, in their order.
  struct Update {
    std::span<const TupleId> ids;
    std::span<const std::size_t> attributes;
    TupleStream& values;
  };
  /// Called for a tuple that stands in the table, or in a row group of which little changes, with its new values.
  using UpdateOne = std::function<Status(TupleId id, const Tuple& values)>;
  Status update(const Update& update, const UpdateOne& update_one, const algebra3d::Context& context);

 private:
  /// The changes of a group that is being written anew.
  struct Edit {
    std::size_t awaited = 0;          // tuples
    std::vector<std::uint32_t> rows;  // of those that have come
    std::vector<ValueColumn> values;  // by attribute of the update, a row for each
    std::size_t bytes = 0;            // of these, estimated
  };
  struct Marked;
  /// The chunks of an attribute: as it is, and as it is to be.
  struct Chunks {
    std::shared_ptr<const ColumnChunk> old;
    RowGroups::NewChunk made;
  };
  Result<std::vector<Marked>> find(std::span<const TupleId> ids) const;
  std::vector<bool> indexed_attributes() const;
  Status erase_from_indexes(std::span<const TupleId> ids);
  Result<std::map<std::size_t, Edit>> begin_edits(std::span<const Marked> tuples) const;
  static void add(const Batch& batch, const SelectedRows& rows, Edit& edit);
  Status write(std::size_t group, const Edit& edit, const Update& update, const UpdateOne& update_one);
  Result<Chunks> new_chunk(const GroupContent& content, std::size_t attribute, const Edit& edit,
                           const ValueColumn& values) const;
  Status change_index(const GroupContent& content, std::size_t attribute, const ColumnChunk& chunk, const Edit& edit,
                      const ValueColumn& values);

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  CatalogueEntry& entry_;
};

}  // namespace queries
