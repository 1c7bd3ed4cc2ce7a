#pragma once

#include <atomic>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"

namespace algebra3d {

/// Bounds the distance of a candidate of several turns, which is a sum over these, by that from the candidate with
/// which they began: faces that both have are at no distance. `small`: distances up to that need no better bound.
/// `farthest`: the largest distance of one turn. Errors: interrupted. Cost: linear, and that of bounded_distance and
/// covering_bound for the other faces.
Status tighten_distance(RoundingCandidate& candidate, const RoundingCandidate& first, double small, double farthest,
                        const std::atomic<bool>* cancel);

}  // namespace algebra3d
