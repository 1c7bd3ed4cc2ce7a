#pragma once

#include <vector>

#include "algebra3d/kernel/distance/detail/rounded_closest.h"
#include "algebra3d/kernel/distance/distance.h"

namespace algebra3d::distances {

/// A pair of faces, with bounds of their distance.
struct CandidatePair {
  FaceId first, second;
  DistanceBounds bounds;
};

/// Pairs of faces of two sets, one of which is at the distance of the sets, ascending by their lower bounds, then by
/// their faces. Rounded arithmetic only. `reach` limits the search: no candidates if the sets are certainly farther
/// apart. The search ends with one candidate as soon as a pair is certainly not farther apart than `enough`.
Result<std::vector<CandidatePair>> find_candidates(const DistanceOperand& a, const DistanceOperand& b, double reach,
                                                   double enough, const Monitor& monitor);

}  // namespace algebra3d::distances
