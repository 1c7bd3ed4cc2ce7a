#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/operands.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d::arrangement {

/// Pairs of faces of different operands whose boxes meet, the one of the earlier operand first; in an order that
/// depends on the operands alone. Errors: interrupted; limit_exceeded if there are more than max_pairs.
Result<std::vector<std::pair<std::uint32_t, std::uint32_t>>> candidate_pairs(const Operands& operands,
                                                                             const Monitor& monitor,
                                                                             std::size_t max_pairs = SIZE_MAX);

}  // namespace algebra3d::arrangement
