#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "queries/store/detail/row_columns.h"

namespace queries {

/// A stream of the tuples of a stored relation in the order of ids, as they are at the first `next`; later changes by
/// the statement are not seen. Reads in pages and keeps no SQLite statement open between them, so that scans and
/// changes may alternate. A page is a part of a row group, with the tuples that stand beside it, or rows of the table.
/// At the end it checks that no tuple was missing.
class RelationScan final : public TupleStream {
 public:
  /// Reads all attributes, and proves each row.
  RelationScan(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout);
  /// Reads some attributes, by their places; the others are undefined. Rows are proved only where pages are not. Row
  /// groups whose values are all outside of some bounds are left out.
  RelationScan(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout, std::vector<bool> read,
               std::vector<AttributeBounds> bounds = {});

  /// Leaves out the tuples before one; to be called before the first `next`.
  void begin_at(TupleId first) { after_ = first - 1; }
  Result<TuplePtr> next() override;
  bool has_batches() const override { return has_batches_; }
  Result<const Batch*> next_batch(std::size_t most) override;
  std::vector<StageCount> stages() const override;

 private:
  Status start();
  Status find_loose();
  Result<bool> read_tuples(std::size_t most);
  Status read_page(std::size_t most);
  Status read_table();
  Status read_rows();
  Status read_wide_rows();
  Status restore_changed();
  Status read_group(std::size_t most);
  Status read_beside();
  bool may_leave_out(const RowGroup& group, std::size_t most) const;
  Status read_chunks(const RowGroup& group);
  Status fetch(TupleId id, RowReader& reader) const;
  Status check_end() const;

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  std::vector<bool> read_;
  std::vector<AttributeBounds> bounds_;
  const bool has_batches_;
  const std::uint64_t statement_;
  bool is_at_end_ = false;
  bool is_whole_ = true;  // all tuples are read
  ChangeTime time_ = 0;
  TupleId after_ = 0;      // all ids up to this one have been read
  TupleId page_end_ = 0;   // last id of the page that is being read
  TupleId table_end_ = 0;  // last id before the next row group
  TupleId last_ = 0;       // greatest id when the scan began
  std::uint64_t sum_ = 0, expected_sum_ = 0;
  std::optional<RowColumns> page_;  // from the start on
  std::string page_sql_;
  std::size_t position_ = 0;  // in the page

  // The row groups, as they were when the scan began.
  GroupListPtr groups_;
  std::uint64_t left_out_ = 0;
  std::size_t group_ = 0;                                   // the next one, or the one that is being read
  std::size_t group_row_ = 0;                               // its next row
  std::vector<std::shared_ptr<const ColumnChunk>> chunks_;  // its chunks, of the attributes that are read
  std::vector<TupleId> loose_;                              // tuples of the table with ids of row groups
  std::size_t loose_position_ = 0;
};

}  // namespace queries
