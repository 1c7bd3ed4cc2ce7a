#include "algebra3d/repair/winding_solid.h"

#include <cstdint>
#include <vector>

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {

Result<TriangleMesh> winding_solid(const TriangleMesh& mesh, const WindingRule& rule, const std::atomic<bool>* cancel,
                                   std::size_t max_pairs) {
  ASSIGN_OR_RETURN(const std::vector<Entanglement> entanglements, disentangle(mesh, cancel));
  // Each entangled triangle is an operand by itself, so that it is divided at all others.
  std::vector<TriangleMesh> parts;
  std::vector<FaceId> free;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (entanglements[f] == Entanglement::none) free.emplace_back(f);
    if (entanglements[f] == Entanglement::entangled) parts.push_back(submesh(mesh, std::vector{FaceId(f)}));
  }
  if (!free.empty()) parts.push_back(submesh(mesh, free));
  std::vector<Operand> operands;
  operands.reserve(parts.size());
  for (const TriangleMesh& part : parts) operands.push_back({&part, 0});
  ASSIGN_OR_RETURN(const SolidArrangement arrangement,
                   SolidArrangement::make(operands, cancel, {Closure::together, max_pairs}));
  return arrangement.solid([&](const Holding& holding) { return holding[0] != 0 && rule(holding[0]); });
}

}  // namespace algebra3d
