#pragma once

#include <functional>

#include "queries/streams/datum.h"
#include "queries/streams/mapping.h"

namespace queries {

/// Whether a tuple goes on. Called from several threads at once, each with a context of its own.
using TupleCondition = std::function<Result<bool>(const Tuple& tuple, Context& context)>;

/// The tuples that fulfil a condition which takes long, in their order. They are read in blocks, whose tuples are
/// examined in parallel; the first blocks are small, so that the first tuples come soon. Errors: those of the stream
/// and of the first tuple whose condition fails. Interruptible between tuples.
TupleStreamPtr parallel_filter(TupleStreamPtr stream, TupleCondition condition, Context& context);

}  // namespace queries
