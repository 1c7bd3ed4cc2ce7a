#include "algebra3d/kernel/rounding/detail/surface_rounding.h"

#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/kernel/autorefinement/valid_parts.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"

namespace algebra3d {

SurfaceRounding::SurfaceRounding(const TriangleMesh& surface, const CoordinateGrid& grid, const Monitor& monitor)
    : RoundingJob(surface, largest_coordinate(surface), grid, monitor) {}

Result<std::optional<TriangleMesh>> SurfaceRounding::divided(const TriangleMesh& mesh, std::size_t max_pairs) const {
  A3D_ASSIGN(const ValidParts parts, ValidParts::make(mesh, monitor()));
  auto pieces = unite_surfaces(parts.operands(), monitor(), {Closure::together, max_pairs});
  if (!pieces.ok() && pieces.error().code == ErrorCode::limit_exceeded) return std::optional<TriangleMesh>();
  if (!pieces.ok()) return std::move(pieces).error();
  return std::optional(*std::move(pieces));
}

Result<bool> SurfaceRounding::accept_moved() {
  if (!are_apart(vertices())) return false;
  A3D_ASSIGN(const bool is_valid, prove(with_its_faces(mesh(), vertices())));
  return is_valid && result_.contact_vertices == 0;
}

Result<bool> SurfaceRounding::prove(const RoundingCandidate& candidate) {
  if (candidate.mesh.is_empty() && candidate.reach > kFirstReach * spacing()) return false;
  const ProofOptions options{
      .thoroughness = Thoroughness::first_defect, .cancel = cancel(), .known = candidate.kept_faces()};
  A3D_ASSIGN(const ValidityReport report, prove_surface(candidate.mesh, options));
  if (!report.is_valid()) return false;
  result_ = RoundedSurface{
      candidate.mesh, "", 0, candidate.movement.distance, candidate.method, report.contact_vertices, candidate.reach};
  return true;
}

}  // namespace algebra3d
