#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "queries/store/detail/stored_rows.h"
#include "queries/streams/batch.h"
#include "queries/streams/relation.h"

namespace queries {

/// Reads tuples of a stored relation by their ids, in columns, as they were at the first `read`; later changes by the
/// statement are not seen. Of row groups it reads the chunks of the wanted attributes, each once for all ids of a call,
/// and decodes the wanted rows alone.
class StoredTuples final : public TuplesById {
 public:
  /// `read`: by attribute; the others are undefined.
  StoredTuples(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
               std::vector<bool> read);

  Result<const Batch*> read(std::span<const TupleId> ids) override;

 private:
  struct Wanted {
    std::size_t group;  // its position in the list
    RowPlace place;     // in the group, and in the columns
  };
  Status start();
  Status find(std::span<const TupleId> ids);
  Status read_loose(TupleId id, std::size_t place);
  Status read_group(const RowGroup& group, std::span<const RowPlace> places, bool is_kept);

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  std::vector<bool> read_;
  const std::uint64_t statement_;
  ChangeTime time_ = 0;
  GroupListPtr groups_;              // from the first call on
  std::optional<RowReader> reader_;  // of the table
  std::vector<Wanted> wanted_;
  std::vector<RowPlace> places_;
  std::vector<std::uint32_t> present_;
  OwnBatch batch_;
};

}  // namespace queries
