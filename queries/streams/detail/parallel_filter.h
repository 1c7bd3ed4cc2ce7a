#pragma once

#include <functional>
#include <span>
#include <vector>

#include "queries/streams/datum.h"
#include "queries/streams/mapping.h"

namespace queries {

/// Which tuples of a block go on: a truth value for each.
using BlockCondition = std::function<Result<std::vector<bool>>(std::span<const TuplePtr> block)>;

/// The tuples for which a condition holds that is cheaper for many at a time, in their order. They are read in blocks
/// of at most `largest_block`; the first blocks are small, so that the first tuples come soon. Errors: those of the
/// stream and of the condition; interrupted.
TupleStreamPtr block_filter(TupleStreamPtr stream, std::size_t largest_block, BlockCondition condition,
                            const Context& context);

/// Whether a tuple goes on. Called from several threads at once, each with a context of its own.
using TupleCondition = std::function<Result<bool>(const Tuple& tuple, Context& context)>;

/// A filter for a condition that takes long: the tuples of a block are examined in parallel. Errors: those of the
/// stream and of the first tuple whose condition fails. Interruptible between tuples.
TupleStreamPtr parallel_filter(TupleStreamPtr stream, TupleCondition condition, Context& context);

}  // namespace queries
