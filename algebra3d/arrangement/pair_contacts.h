#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/contact.h"
#include "algebra3d/arrangement/facets.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d::arrangement {

/// Two faces that touch.
struct PairContact {
  std::uint32_t first_face, second_face;
  TriangleContact contact;
};

/// What the faces of each pair have in common, for those that touch, in the order of the pairs. Planes that are asked
/// for are made in `facets`. Errors: interrupted.
Result<std::vector<PairContact>> pair_contacts(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs,
                                               const Operands& operands, Facets& facets, const Monitor& monitor);

}  // namespace algebra3d::arrangement
