#pragma once

#include <optional>
#include <vector>

#include "queries/streams/stream_operator.h"

namespace queries {

/// Groups of tuples with equal keys, and what is computed of each.
struct HashGrouping {
  std::vector<std::size_t> keys;
  std::vector<SortKey> order;  ///< of the groups; of the same attributes as the keys
  std::vector<GroupAggregate> aggregates;
  std::vector<const algebra3d::Type*> result_types;  ///< of the keys, then of the aggregates
};

/// The keys and the aggregates of each group, in order: what sorting the tuples and aggregating runs of equal keys
/// would give. Reads the stream to its end. Tuples of groups for which the work memory has no room are sorted;
/// `functions` compute then what the aggregates do, of a relation with the tuples of `tuple`. Errors: those of the
/// stream, of temporary files, interrupted.
Result<TupleStreamPtr> hashed_groups(TupleStream& tuples, const TypeExpr& tuple, const HashGrouping& grouping,
                                     const DatumList& functions, algebra3d::Context& context);

}  // namespace queries
