#pragma once

#include "queries/streams/datum.h"
#include "queries/streams/detail/nearest_search.h"

namespace queries {

/// Each tuple of a stream with each of its nearest partners, concatenated: in the order of the stream, the nearest
/// partner first. Tuples whose value is undefined or empty have none. For a self-join, `probes` must yield the tuples
/// of `partners` in the same order.
TupleStreamPtr nearest_join(TupleStreamPtr probes, TupleBuffer partners, const NearestTask& task,
                            const Context& context);

/// The concatenation of the tuple of the stream and the partner that are nearest to each other; no tuple if there is
/// none. Equal distances: the earlier tuple of the stream, then the earlier partner. `task.limit` is 1.
TupleStreamPtr closest_pair(TupleStreamPtr probes, TupleBuffer partners, const NearestTask& task,
                            const Context& context);

}  // namespace queries
