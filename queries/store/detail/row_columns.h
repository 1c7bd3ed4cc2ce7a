#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "queries/store/detail/stored_rows.h"
#include "queries/streams/batch.h"

namespace queries {

/// Rows of a relation in columns: a page of a scan, with the attributes that are read. The rest is neither decoded nor
/// copied.
class RowColumns final : public RowSink {
 public:
  /// `read`: by attribute. `proves_rows`: each row is proved by its checksum, for which all of it is read; else only
  /// pages are, by theirs. The rows are as of `time`.
  RowColumns(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
             const std::vector<bool>& read, bool proves_rows, ChangeTime time);

  /// The columns of the table that `take` expects, in their order.
  const std::vector<std::size_t>& cells() const { return cells_; }

  /// Removes all rows. Of those added afterwards, `take` takes up to `most`, with ids greater than `after`.
  void restart(TupleId after, std::size_t most);
  bool take(std::span<Cell> row) override;
  /// The status of the rows taken. Errors: database_corrupt.
  const Status& status() const { return taken_status_; }
  bool is_full() const;
  /// The last id that was taken.
  TupleId last() const { return last_; }
  /// Puts rows in the places of those with these ids, which are ascending, or between the others: `fetch(id, reader)`
  /// gives a row to the reader.
  template <typename Fetch>
  Status replace(const std::vector<TupleId>& ids, Fetch fetch);
  /// In place of rows from a table: `count` rows of a row group from the row `first` on, of which those are left that
  /// are alive. `chunks`: one for each attribute that is read.
  Status take_group(const RowGroup& group, const std::vector<std::shared_ptr<const ColumnChunk>>& chunks,
                    std::size_t first, std::size_t count);
  /// As `take_group`, without any row.
  void take_none();
  /// Puts rows with these ids, which are ascending, between the others, like `replace`.
  template <typename Fetch>
  Status add(const std::vector<TupleId>& ids, Fetch fetch);
  /// Begins to take rows of the table that stand beside those of a group: this many, with ids greater than `after`.
  void begin_beside(std::size_t count, TupleId after);
  /// Puts them between the others. False if they are not those with these ids.
  bool end_beside(const std::vector<TupleId>& ids);
  /// The attributes that are read.
  std::vector<std::size_t> attributes() const;
  /// The sum of the checksums of the rows.
  std::uint64_t sum() const;
  /// The rows as a batch, valid until `restart` or `replace`.
  const Batch& batch() const { return batch_; }
  /// The rows of the batch from the `first` on.
  const Batch& rest(std::size_t first);
  void finish();

 private:
  struct ReadAttribute {
    std::size_t attribute;
    std::size_t cell;  // the first of its cells in a row
    ValueColumn column;
  };
  Status put(ReadAttribute& read, std::span<const Cell> row, std::size_t place);
  Status put_from_reader(ReadAttribute& read, std::size_t place);
  std::size_t add_cells(const AttributeColumns& columns);
  void erase(const std::vector<TupleId>& ids);
  Status add_from_reader();
  void order_rows();

  std::shared_ptr<const RelationLayout> layout_;
  const bool proves_rows_;
  RowReader reader_;
  std::vector<std::size_t> cells_;
  std::vector<ReadAttribute> read_;
  std::vector<std::unique_ptr<ValueColumn>> unread_;
  std::vector<TupleId> ids_;
  std::vector<std::uint64_t> checksums_;
  bool is_whole_ = true;
  std::vector<std::uint32_t> positions_;  // of the rows in their order, if they are not whole
  std::string proved_;                    // reused for all rows
  std::size_t group_rows_ = 0;            // rows before those that stand beside a group
  std::size_t most_ = 0;
  std::size_t text_bytes_ = 0;
  TupleId last_ = 0;
  Status taken_status_;
  Batch batch_;
};

template <typename Fetch>
Status RowColumns::replace(const std::vector<TupleId>& ids, Fetch fetch) {
  erase(ids);
  return add(ids, fetch);
}

template <typename Fetch>
Status RowColumns::add(const std::vector<TupleId>& ids, Fetch fetch) {
  for (const TupleId id : ids) {
    A3D_TRY(fetch(id, reader_));
    A3D_TRY(add_from_reader());
  }
  order_rows();
  return {};
}

}  // namespace queries
