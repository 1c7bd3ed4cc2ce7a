#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "queries/store/detail/stored_rows.h"

namespace queries {

/// A page of rows of a relation, verified by their checksums. Tuples are made from them one by one, on demand.
class RowPage final : public RowSink {
 public:
  struct Row {
    TupleId id;
    std::uint64_t checksum;
    std::size_t begin;  // offset in the bytes
  };

  explicit RowPage(std::shared_ptr<const RelationLayout> layout) : layout_(std::move(layout)) {}

  /// Removes all rows. Rows added afterwards have ids greater than `after`.
  void clear(TupleId after);
  bool take(std::span<Cell> row) override;
  /// The status of the rows taken. Errors: database_corrupt.
  const Status& status() const { return status_; }
  bool is_full() const;

  /// Adds a row that did not come through `take`, in the order of ids.
  Status add(std::span<Cell> row);
  void erase(const std::vector<TupleId>& ids);
  const std::vector<Row>& rows() const { return rows_; }
  std::string_view bytes(const Row& row) const { return std::string_view(bytes_).substr(row.begin); }

 private:
  std::shared_ptr<const RelationLayout> layout_;
  std::string bytes_;
  std::vector<Row> rows_;  // by ascending id
  TupleId last_ = 0;
  Status status_;
};

/// A stream of the tuples of a stored relation in the order of ids, as they are at the first `next`; later changes by
/// the statement are not seen. Reads in pages and keeps no SQLite statement open between them, so that scans and
/// changes may alternate. At the end it checks that no tuple was missing.
class RelationScan final : public TupleStream {
 public:
  RelationScan(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout);

  Result<TuplePtr> next() override;

 private:
  Status start();
  Status read_page();
  Status read_rows();
  Status read_wide_rows();
  Status restore_changed();
  Status check_end() const;

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  const std::uint64_t statement_;
  bool is_started_ = false;
  bool is_at_end_ = false;
  ChangeTime time_ = 0;
  TupleId after_ = 0;     // all ids up to this one have been read
  TupleId page_end_ = 0;  // last id of the page that is being read
  TupleId last_ = 0;      // greatest id when the scan began
  std::uint64_t sum_ = 0, expected_sum_ = 0;
  RowPage page_;
  std::size_t position_ = 0;  // in the page
  std::optional<RowReader> reader_;
};

}  // namespace queries
