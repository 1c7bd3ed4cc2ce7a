#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "queries/store/detail/catalogue.h"
#include "queries/store/detail/chunk_builder.h"
#include "queries/store/detail/relation_layout.h"
#include "queries/store/detail/sqlite_connection.h"
#include "queries/store/detail/tables.h"

namespace queries {

/// What does not change of a row group: which tuples it has, and what its column chunks are.
struct GroupContent {
  std::int64_t first = 0;              ///< id of its first tuple
  std::int64_t last = 0;               ///< id of its last one
  std::uint32_t count = 0;             ///< of tuples
  std::vector<std::uint32_t> offsets;  ///< of the ids from `first`; empty: they are consecutive

  struct Column {
    std::uint64_t checksum = 0;  ///< of the chunk's bytes, seeded with its place
    ValueRange range;
  };
  std::vector<Column> columns;  ///< by attribute

  std::int64_t id(std::size_t row) const {
    return first + static_cast<std::int64_t>(offsets.empty() ? row : offsets[row]);
  }
  /// The row of a tuple; none: it is not here.
  std::optional<std::size_t> row_of(std::int64_t id) const;
};

/// A row group [Parquet, DuckDB]: some thousand tuples of a relation in columns. Tuples that were deleted, or
/// overwritten and so stand in the relation's table, are dead in it.
struct RowGroup {
  std::shared_ptr<const GroupContent> content;
  std::uint64_t content_sum = 0;            ///< of the content
  std::shared_ptr<const std::string> dead;  ///< a bit for each row; null: all are alive
  std::uint32_t dead_count = 0;
  std::uint64_t checksum = 0;  ///< of the content and of which tuples are dead: what the relation's sum counts

  bool is_dead(std::size_t row) const { return dead != nullptr && (((*dead)[row / 8] >> (row % 8)) & 1) != 0; }
  std::uint32_t live_count() const { return content->count - dead_count; }
};

/// A tuple of a row group.
struct GroupRow {
  std::size_t group = 0;  ///< its position in the list
  std::size_t row = 0;
};

/// The row groups of a relation by ascending ids, as they are at some time.
class GroupList {
 public:
  explicit GroupList(std::vector<RowGroup> groups = {}) : groups_(std::move(groups)) {}

  bool is_empty() const { return groups_.empty(); }
  std::size_t size() const { return groups_.size(); }
  const RowGroup& operator[](std::size_t index) const { return groups_[index]; }
  const std::vector<RowGroup>& all() const { return groups_; }
  /// The place of a tuple that is alive in a group.
  std::optional<GroupRow> find(std::int64_t id) const;
  /// Whether a tuple has a row in a group, be it alive or dead there.
  bool holds(std::int64_t id) const { return place(id).has_value(); }
  /// The last id of all groups; 0 without groups.
  std::int64_t last() const { return groups_.empty() ? 0 : groups_.back().content->last; }
  /// The sum of the groups' checksums.
  std::uint64_t sum() const;

 private:
  friend class RowGroups;
  std::optional<GroupRow> place(std::int64_t id) const;
  std::vector<RowGroup> groups_;
};
using GroupListPtr = std::shared_ptr<const GroupList>;

/// The row groups of the relations of a database. Lists are read when they are first asked for, and kept until
/// `forget`; a reader keeps the list that it began with. Groups are replaced by `replace` at the end of a statement
/// only. A chunk that `rewrite` replaces within a statement stays in the file as long as a reader may need it: then the
/// new one is in memory until `flush`, which also writes which tuples are dead. Used by one thread.
class RowGroups {
 public:
  RowGroups(SqliteConnection& connection, Catalogue& catalogue) : connection_(connection), catalogue_(catalogue) {}

  /// The groups of a relation. Errors: database_corrupt.
  algebra3d::Result<GroupListPtr> list(const RelationLayout& layout);
  /// A column chunk, which is proved by its checksum. Errors: database_corrupt with relation, attribute and tuples.
  algebra3d::Result<std::shared_ptr<const ColumnChunk>> read(const RelationLayout& layout, const GroupContent& group,
                                                             std::size_t attribute);
  /// As `read`, for single tuples: chunks are kept for the next one.
  algebra3d::Result<std::shared_ptr<const ColumnChunk>> kept(const RelationLayout& layout, const GroupContent& group,
                                                             std::size_t attribute);

  /// A new group with chunks for all attributes, behind all others of its relation; it is in the list after `append`.
  /// Makes the tables first if the file has none.
  algebra3d::Result<RowGroup> write(const RelationLayout& layout, std::span<const std::int64_t> ids,
                                    std::span<const EncodedChunk> chunks);
  algebra3d::Status append(const RelationLayout& layout, std::vector<RowGroup> groups);
  /// Marks tuples of a group, by its position in the list, as dead; by how much the checksum of the group changes.
  algebra3d::Result<std::uint64_t> mark_dead(const RelationLayout& layout, std::size_t group,
                                             std::span<const std::uint32_t> rows);
  /// The chunk of an attribute that comes in place of another one.
  struct NewChunk {
    std::size_t attribute = 0;
    EncodedChunk chunk;
  };
  /// Replaces chunks of a group, by its position in the list; by how much the checksum of the group changes.
  algebra3d::Result<std::uint64_t> rewrite(const RelationLayout& layout, std::size_t group,
                                           std::vector<NewChunk> chunks);
  /// Puts another list in place of the current one, of which nothing is left to be flushed.
  algebra3d::Status replace(const RelationLayout& layout, std::vector<RowGroup> groups);
  /// Erases the row and the chunks of a group, not its place in the list.
  algebra3d::Status erase(const RelationLayout& layout, const RowGroup& group);
  /// Erases everything of the table with this number.
  algebra3d::Status erase_all(std::int64_t table_number);
  /// Writes which tuples are dead, and new chunks that are not in the file.
  algebra3d::Status flush();
  /// The tables whose groups have changed since the last `flush`.
  std::vector<std::int64_t> changed_tables() const;

  /// Drops everything that is in memory, after a rollback or when another process has written.
  void forget();
  void forget(std::int64_t table_number);

  /// The groups of a table as they stand in the file, for the integrity check: those that are right, and what is wrong
  /// with the others.
  struct Audit {
    std::vector<RowGroup> groups;
    std::vector<algebra3d::Error> faults;
  };
  algebra3d::Result<Audit> audit(const RelationLayout& layout);

 private:
  struct Table {
    std::shared_ptr<GroupList> list;
    std::map<std::int64_t, std::size_t> changed;  // groups to be written, by their first ids
  };
  struct ChunkKey {
    std::int64_t table_number;
    std::int64_t first;
    std::size_t attribute;
    friend auto operator<=>(const ChunkKey&, const ChunkKey&) = default;
  };
  struct Kept {
    ChunkKey key;
    std::uint64_t checksum;
    std::shared_ptr<const ColumnChunk> chunk;
  };

  /// A chunk that is to come into the file, as its group has it by this checksum.
  struct Unwritten {
    std::uint64_t checksum;
    std::shared_ptr<const std::string> bytes;
  };

  algebra3d::Status write_chunk(const ChunkKey& key, std::string_view bytes);
  algebra3d::Result<std::string> chunk_bytes(const RelationLayout& layout, const GroupContent& group,
                                             std::size_t attribute);
  bool has_tables() const { return catalogue_.version() >= kFirstVersionWithRowGroups; }
  algebra3d::Result<Table*> table(const RelationLayout& layout);
  GroupList& own_list(Table& table);
  void shrink_kept();

  SqliteConnection& connection_;
  Catalogue& catalogue_;
  std::map<std::int64_t, Table> tables_;
  std::map<ChunkKey, std::vector<Unwritten>> unwritten_;  // the latest one last
  std::list<Kept> kept_;                                  // latest used first
  std::map<ChunkKey, std::list<Kept>::iterator> kept_places_;
  std::size_t kept_bytes_ = 0;
};

}  // namespace queries
