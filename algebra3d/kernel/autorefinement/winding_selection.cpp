#include "algebra3d/kernel/autorefinement/winding_selection.h"

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"
#include "base/propagate.h"

namespace algebra3d {

Result<TriangleMesh> solid_by_winding(const ValidParts& parts, const WindingRule& rule, const Monitor& monitor,
                                      const ArrangementOptions& limits) {
  A3D_ASSIGN(const SolidArrangement arrangement,
             SolidArrangement::make(parts.operands(), monitor, {Closure::together, limits.max_pairs, limits.max_cuts}));
  return arrangement.solid([&](const WindingVector& windings) { return windings[0] != 0 && rule(windings[0]); });
}

Result<TriangleMesh> solid_by_winding(const TriangleMesh& mesh, const WindingRule& rule, const Monitor& monitor,
                                      const ArrangementOptions& limits) {
  A3D_ASSIGN(const ValidParts parts, ValidParts::make(mesh, monitor));
  return solid_by_winding(parts, rule, monitor, limits);
}

}  // namespace algebra3d
