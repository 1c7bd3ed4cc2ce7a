#include "algebra3d/kernel/rounding/rounded_surface.h"

#include <cstddef>
#include <optional>

#include "algebra3d/kernel/rounding/detail/met_cells.h"
#include "algebra3d/kernel/rounding/detail/rounding_ladder.h"
#include "algebra3d/kernel/rounding/detail/square_cover.h"
#include "algebra3d/kernel/rounding/detail/surface_rounding.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Puts faces of cubes in place of the surface; false if the type has no numbers beyond it.
Result<bool> cover(SurfaceRounding& job) {
  A3D_TRY(job.begin("covering with faces of cubes"));
  A3D_ASSIGN(const std::optional<MetCells> met,
             finest_met_cells(job.mesh(), job.grid(), cell_budget(job.mesh()), job.cancel()));
  if (!met) return false;
  A3D_ASSIGN(TriangleMesh squares, square_cover(job.mesh(), *met, job.cancel()));
  A3D_ASSIGN(const bool is_valid,
             job.accept({std::move(squares), Movement(met->lattice.diagonal()), 0, RoundingMethod::faces_of_cubes}));
  if (!is_valid) return Error(ErrorCode::internal, "faces of cubes are not a valid surface");
  return true;
}

}  // namespace

Result<RoundedSurface> rounded_surface(const TriangleMesh& surface, const CoordinateGrid& grid,
                                       const Monitor& monitor) {
  SurfaceRounding job(surface, grid, monitor);
  if (!job.vertices().are_finite) return RoundedSurface{std::nullopt, out_of_range_text(job.size(), grid)};
  if (job.vertices().moved == 0) return RoundedSurface{surface};
  A3D_ASSIGN(bool is_found, round_whole(job));
  if (!is_found) {
    A3D_ASSIGN(is_found, cover(job));
  }
  if (!is_found) return RoundedSurface{std::nullopt, out_of_range_text(job.size(), grid)};
  RoundedSurface rounded = job.result();
  rounded.moved_vertices = job.vertices().moved;
  return rounded;
}

}  // namespace algebra3d
