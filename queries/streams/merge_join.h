#pragma once

#include "queries/streams/adjacent_groups.h"
#include "queries/streams/pairs.h"

namespace queries {

/// What a merge join is to do. `name` and the attribute names are for messages.
struct MergeJoinPlan {
  JoinTypes types;
  JoinKeys keys;
  bool is_outer = false;  ///< tuples without partners come too, beside undefined values
  std::string name;
};

/// The pairs of tuples of two streams with equal, defined keys, in the order of the keys; equal ones in the order of
/// the left and then of the right stream. Both are sorted by their key, ascending. Errors: wrong_usage if one is not.
TupleStreamPtr merge_join(TupleStreamPtr left, TupleStreamPtr right, const MergeJoinPlan& plan, const Context& context);

}  // namespace queries
