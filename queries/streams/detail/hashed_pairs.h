#pragma once

#include <memory>
#include <vector>

#include "queries/streams/detail/join_table.h"
#include "queries/streams/stream_operator.h"

namespace queries {

/// What a join makes of its pairs.
struct JoinOutput {
  JoinKeys keys;
  /// By attribute of the joined tuples, whether somebody reads it; empty: all.
  std::vector<bool> read = {};
  /// A function of both tuples that selects pairs; null: all pairs.
  std::shared_ptr<const Function> predicate = nullptr;

  bool is_read(std::size_t attribute) const { return read.empty() || read[attribute]; }
};

/// Each tuple of the probe side joined with its partners in a table, which is finished: in the order of the probe side.
TupleStreamPtr hashed_pairs(TupleStreamPtr probe, JoinTable table, JoinOutput output,
                            const algebra3d::Context& context);

}  // namespace queries
