#pragma once

#include <memory>
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

}  // namespace queries
