#include "algebra3d/arrangement/patches.h"

namespace algebra3d::arrangement {
namespace {

/// Numbers the faces of one operand.
void flood(const Operands& operands, const Facets& facets, std::uint32_t operand, Patches& result) {
  std::vector<std::uint32_t> stack, along;
  const auto reach = [&](std::uint32_t face, std::uint32_t patch) {
    if (result.of_face[face] != kNone || facets.of_face(face) != kNone) return;
    result.of_face[face] = patch;
    stack.push_back(face);
  };
  for (std::uint32_t face = operands.first_face(operand); face < operands.first_face(operand + 1); ++face) {
    if (result.of_face[face] != kNone || facets.of_face(face) != kNone) continue;
    const auto patch = static_cast<std::uint32_t>(result.patches.size());
    result.patches.push_back({operand, face});
    reach(face, patch);
    while (!stack.empty()) {
      const std::uint32_t current = stack.back();
      stack.pop_back();
      for (std::uint32_t h = 3 * current; h < 3 * current + 3; ++h) {
        const std::uint32_t other = operands.opposite(h);
        if (other != kNone) {
          reach(other / 3, patch);
          continue;
        }
        operands.halfedges_along(h, along);
        for (const std::uint32_t neighbour : along) reach(neighbour / 3, patch);
      }
    }
  }
}

}  // namespace

Patches find_patches(const Operands& operands, const Facets& facets) {
  Patches result;
  result.of_face.assign(operands.face_count(), kNone);
  for (std::uint32_t operand = 0; operand < operands.count(); ++operand) flood(operands, facets, operand, result);
  return result;
}

}  // namespace algebra3d::arrangement
