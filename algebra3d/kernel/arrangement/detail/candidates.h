#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"

namespace algebra3d::arrangement {

/// Two faces of different operands, that of the earlier operand first.
struct FacePair {
  InputFaceId first, second;

  friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

/// Output of stage 1: the pairs of faces that may touch.
struct Candidates {
  /// All pairs that touch and others whose boxes meet or nearly do, each once. Of long or slanted faces some whose
  /// boxes meet are left out, since rounded numbers show that they are apart.
  std::vector<FacePair> pairs;
};

/// Stage 1: finds the pairs of faces of different operands whose boxes meet. Their order depends on the operands alone.
/// Errors: interrupted; limit_exceeded if there are more than max_pairs. Cost: near-linear in the faces of operands
/// whose boxes meet, and in the pairs.
Result<Candidates> find_candidates(const Operands& operands, const Monitor& monitor, std::size_t max_pairs = SIZE_MAX);

/// Every violated invariant, one sentence each: both faces of a pair exist, that of the earlier operand comes first,
/// and no pair comes twice. Cost: n log n.
std::vector<std::string> audit(const Operands& operands, const Candidates& candidates);

}  // namespace algebra3d::arrangement
