#pragma once

#include <atomic>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"

namespace algebra3d {

/// Replaces the distance of a candidate of several turns, which is a sum over the turns, by a bound measured against
/// `first`, the candidate before the first turn: faces that both have are at distance 0. `small`: distances up to that
/// need no better bound. `farthest`: the largest distance of one turn. Errors: interrupted. Cost: linear, and that of
/// bounded_distance and covering_bound for the other faces.
Status tighten_distance(RoundingCandidate& candidate, const RoundingCandidate& first, double small, double farthest,
                        const std::atomic<bool>* cancel);

}  // namespace algebra3d
