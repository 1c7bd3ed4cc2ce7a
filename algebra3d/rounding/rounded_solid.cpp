#include "algebra3d/rounding/rounded_solid.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/rounding/detail/met_cells.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"
#include "algebra3d/rounding/detail/rounding_job.h"
#include "algebra3d/rounding/detail/rounding_rungs.h"
#include "algebra3d/rounding/detail/solid_part.h"

namespace algebra3d {
namespace {

/// Within which reach, in spacings of the grid, features are joined, and facets made coplanar: how far before other
/// ways are tried, and at last. That of coplanar facets grows from rung to rung.
constexpr double kModestReach = 32;
constexpr double kLargestReach = 0x1p20;
constexpr double kReachGrowth = 4;

/// The rungs that a part of the solid is enough for.
Result<bool> round_part(RoundingJob& job) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const RoundingCandidate snapped, snap_rounded(job.mesh(), job.vertices(), job.cancel()));
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_found, job.accept(snapped));
  return is_found || !job.grid().is_floating() ? Result<bool>(is_found)
                                               : join_features(job, snapped, job.grid(), kModestReach);
}

/// All rungs. Where the grid may be coarse for the solid, dividing comes before joining; else it would only take time.
Result<bool> round_whole(RoundingJob& job) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const RoundingCandidate snapped, snap_rounded(job.mesh(), job.vertices(), job.cancel()));
  ALGEBRA3D_ASSIGN_OR_RETURN(bool is_found, job.accept(snapped));
  if (!is_found && !job.grid().is_floating()) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, divide_at_crossings(job));
  }
  if (!is_found) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_features(job, snapped, job.grid(), kModestReach));
  }
  if (is_found) return true;
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<bool> crowded, crowded_vertices(job, snapped.mesh));
  double reach = kFirstReach;
  for (; !is_found && reach <= kModestReach; reach *= kReachGrowth) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_coplanar(job, crowded, reach, kModestReach));
  }
  if (!is_found) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_features(job, snapped, job.grid(), kLargestReach));
  }
  for (; !is_found && reach <= kLargestReach; reach *= kReachGrowth) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_coplanar(job, crowded, reach, kLargestReach));
  }
  return is_found ? Result<bool>(true) : round_to_coarser_grids(job);
}

/// The last rung. Where the type has no numbers beyond the solid, there is no cover.
Result<RoundedSolid> covered(RoundingJob& job) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::optional<RoundingCandidate> cover,
                             cover_of_cubes(job.mesh(), job.grid(), cell_budget(job.mesh()), job.cancel()));
  if (!cover) return RoundedSolid{std::nullopt, kOutOfRange};
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_valid, job.accept(*cover));
  if (!is_valid) return Error(ErrorCode::internal, "a cover of cubes is not valid");
  return job.result();
}

/// The rounded solid: of a part of it, or else of the whole.
Result<RoundedSolid> climbed(const TriangleMesh& solid, SolidPart part, const CoordinateGrid& grid,
                             const std::atomic<bool>* cancel) {
  const bool is_whole = part.is_whole();
  RoundingJob job(solid, std::move(part), grid, cancel);
  if (!job.vertices().are_finite) return RoundedSolid{std::nullopt, kOutOfRange};
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_found, is_whole ? round_whole(job) : round_part(job));
  if (is_found) return job.result();
  if (!is_whole) return climbed(solid, SolidPart(solid), grid, cancel);
  return covered(job);
}

}  // namespace

Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid,
                                   const std::atomic<bool>* cancel) {
  const std::vector<bool> is_moved = are_moved(solid, grid);
  const auto moved_count = static_cast<std::size_t>(std::ranges::count(is_moved, true));
  if (moved_count == 0) return RoundedSolid{solid};
  ALGEBRA3D_ASSIGN_OR_RETURN(RoundedSolid rounded, climbed(solid, SolidPart(solid, is_moved), grid, cancel));
  rounded.moved_vertices = moved_count;
  return rounded;
}

}  // namespace algebra3d
