#pragma once

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/operands.h"
#include "algebra3d/base/error.h"

namespace algebra3d::arrangement {

/// Pairs of faces of different operands whose boxes meet, the one of the earlier operand first; in an order that
/// depends on the operands alone. Errors: interrupted.
Result<std::vector<std::pair<std::uint32_t, std::uint32_t>>> candidate_pairs(const Operands& operands,
                                                                             const std::atomic<bool>* cancel);

}  // namespace algebra3d::arrangement
