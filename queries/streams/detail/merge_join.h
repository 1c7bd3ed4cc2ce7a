#pragma once

#include "queries/streams/detail/adjacent_groups.h"
#include "queries/streams/detail/pairs.h"

namespace queries {

/// The parameters of a merge join. `name` and the attribute names are for messages.
struct MergeJoinParameters {
  JoinTypes types;
  JoinKeys keys;
  bool is_outer = false;  ///< also gives tuples without a partner, padded with undefined values
  std::string name;
};

/// The merge join of two streams that are sorted by their key, ascending: pairs of tuples with equal, defined keys, in
/// key order; among equal keys in the order of the left, then of the right stream. Errors: wrong_usage if a stream is
/// not sorted.
TupleStreamPtr merge_join(TupleStreamPtr left, TupleStreamPtr right, const MergeJoinParameters& parameters,
                          const Context& context);

}  // namespace queries
