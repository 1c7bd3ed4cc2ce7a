#pragma once

#include <memory>
#include <string>
#include <vector>

#include "queries/store/stored_rows.h"

namespace queries {

/// Rows of a relation as they were read: proved by their checksums and not yet made tuples, which are made one by one,
/// when they are asked for.
class RowPage final : public RowTaker {
 public:
  struct Row {
    TupleId id;
    std::uint64_t checksum;
    std::size_t begin;  // in the bytes
  };

  explicit RowPage(std::shared_ptr<const RelationLayout> layout) : layout_(std::move(layout)) {}

  /// Takes all rows away; those that come have greater ids than `after`.
  void clear(TupleId after);
  bool take(std::span<Cell> row) override;
  /// Of what was taken. Errors: database_corrupt.
  const Status& status() const { return status_; }
  bool is_full() const;

  /// A row that was not taken, at its place in the order.
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
