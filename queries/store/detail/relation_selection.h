#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "queries/store/detail/stored_rows.h"
#include "queries/streams/datum.h"

namespace queries {

/// A stream of the tuples of a stored relation with given ids, as they were at the first `next`, like a RelationScan
/// that knows which tuples to read. Errors: database_corrupt for an id without a row.
class RelationSelection final : public TupleStream {
 public:
  /// `ids` is ascending.
  RelationSelection(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
                    std::vector<TupleId> ids);
  Result<TuplePtr> next() override;

 private:
  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  std::uint64_t statement_;
  std::vector<TupleId> ids_;
  std::size_t position_ = 0;
  ChangeTime time_ = 0;
  std::optional<RowReader> reader_;  // from the first tuple on
};

}  // namespace queries
