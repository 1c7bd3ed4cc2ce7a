#include "algebra3d/repair/winding_solid.h"

#include "algebra3d/arrangement/arrangement.h"

namespace algebra3d {

Result<TriangleMesh> winding_solid(const ValidParts& parts, const WindingRule& rule, const Monitor& monitor,
                                   const ArrangementOptions& limits) {
  ASSIGN_OR_RETURN(
      const SolidArrangement arrangement,
      SolidArrangement::make(parts.operands(), monitor, {Closure::together, limits.max_pairs, limits.max_cuts}));
  return arrangement.solid([&](const Holding& holding) { return holding[0] != 0 && rule(holding[0]); });
}

Result<TriangleMesh> winding_solid(const TriangleMesh& mesh, const WindingRule& rule, const Monitor& monitor,
                                   const ArrangementOptions& limits) {
  ASSIGN_OR_RETURN(const ValidParts parts, ValidParts::make(mesh, monitor));
  return winding_solid(parts, rule, monitor, limits);
}

}  // namespace algebra3d
