#include "algebra3d/kernel/rounding/rounded_surface.h"

#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/kernel/autorefinement/valid_parts.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/met_cells.h"
#include "algebra3d/kernel/rounding/detail/remaining_distance.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"
#include "algebra3d/kernel/rounding/detail/rounding_ladder.h"
#include "algebra3d/kernel/rounding/detail/square_cover.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The rounding of a surface.
class SurfaceRounding : public RoundingJob {
 public:
  /// The surface must outlive this.
  SurfaceRounding(const TriangleMesh& surface, const CoordinateGrid& grid, const Monitor& monitor);

  bool is_solid() const override { return false; }
  Folded folded() const override { return Folded::stays; }
  /// All pieces, each once.
  Result<std::optional<TriangleMesh>> divided(const TriangleMesh& mesh, std::size_t max_pairs) const override;
  using RoundingJob::divided;
  /// An empty candidate is refused if a wider reach than the first one was needed.
  Result<bool> prove(const RoundingCandidate& candidate) override;
  Result<std::optional<double>> prove_moved_vertices() override;
  Result<bool> accept_cover() override;

  /// The last accepted candidate; nothing is known of the vertices that moved.
  RoundedSurface&& result() { return std::move(result_); }

 private:
  RoundedSurface result_;
};

SurfaceRounding::SurfaceRounding(const TriangleMesh& surface, const CoordinateGrid& grid, const Monitor& monitor)
    : RoundingJob(surface, largest_coordinate(surface), grid, monitor) {}

Result<std::optional<TriangleMesh>> SurfaceRounding::divided(const TriangleMesh& mesh, std::size_t max_pairs) const {
  A3D_ASSIGN(const ValidParts parts, ValidParts::make(mesh, monitor()));
  auto pieces = unite_surfaces(parts.operands(), monitor(), {Closure::together, max_pairs});
  if (!pieces.ok() && pieces.error().code == ErrorCode::limit_exceeded) return std::optional<TriangleMesh>();
  if (!pieces.ok()) return std::move(pieces).error();
  return std::optional(*std::move(pieces));
}

Result<std::optional<double>> SurfaceRounding::prove_moved_vertices() {
  if (!are_apart(vertices())) return std::optional<double>();
  A3D_ASSIGN(const bool is_valid, prove(with_its_faces(mesh(), vertices())));
  return is_valid && result_.contact_vertices == 0 ? std::optional(result_.largest_movement) : std::nullopt;
}

Result<bool> SurfaceRounding::accept_cover() {
  A3D_ASSIGN(const std::optional<MetCells> met, finest_met_cells(mesh(), grid(), cell_budget(mesh()), cancel()));
  if (!met) return false;
  A3D_ASSIGN(TriangleMesh squares, square_cover(mesh(), *met, cancel()));
  A3D_ASSIGN(const bool is_valid,
             accept({std::move(squares), Movement(met->lattice.diagonal()), 0, RoundingMethod::faces_of_cubes}));
  if (!is_valid) return Error(ErrorCode::internal, "faces of cubes are not a valid surface");
  return true;
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

}  // namespace

Result<RoundedSurface> rounded_surface(const TriangleMesh& surface, const CoordinateGrid& grid,
                                       const Monitor& monitor) {
  SurfaceRounding job(surface, grid, monitor);
  if (!job.vertices().are_finite) return RoundedSurface{std::nullopt, out_of_range_text(job.size(), grid)};
  if (job.vertices().moved == 0) return RoundedSurface{surface};
  A3D_ASSIGN(const bool is_found, climb_ladder(job));
  if (!is_found) return RoundedSurface{std::nullopt, out_of_range_text(job.size(), grid)};
  RoundedSurface rounded = job.result();
  rounded.moved_vertices = job.vertices().moved;
  if (connected_components(*rounded.mesh).count < connected_components(surface).count) {
    A3D_ASSIGN(rounded.largest_movement,
               remaining_distance(surface, *rounded.mesh, grid, rounded.largest_movement, monitor));
  }
  return rounded;
}

}  // namespace algebra3d
