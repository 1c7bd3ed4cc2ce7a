#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/candidates.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {

std::vector<std::string> audit(const Operands& operands, const Candidates& candidates) {
  Violations violations;
  for (const auto& [first, second] : candidates.pairs) {
    if (!violations.expect(first.index() < operands.face_count() && second.index() < operands.face_count(),
                           "pair ({} {}): no such face", first.index(), second.index()))
      continue;
    violations.expect(operands.operand_of(first) < operands.operand_of(second),
                      "pair ({} {}): the faces are of operands {} and {}", first.index(), second.index(),
                      operands.operand_of(first).index(), operands.operand_of(second).index());
  }
  std::vector<FacePair> sorted = candidates.pairs;
  std::ranges::sort(sorted);
  for (auto at = std::ranges::adjacent_find(sorted); at != sorted.end();
       at = std::adjacent_find(std::next(at), sorted.end()))
    violations.expect(false, "pair ({} {}) comes twice", at->first.index(), at->second.index());
  return violations.take();
}

}  // namespace algebra3d::arrangement
