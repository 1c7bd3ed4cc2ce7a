#include "algebra3d/kernel/rounding/detail/rounding_ladder.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "algebra3d/kernel/rounding/detail/rounding_rungs.h"
#include "algebra3d/kernel/rounding/detail/thickening.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Within which reach, in spacings of the grid, features are joined, and facets made coplanar: how far before other
/// ways are tried, and at last.
constexpr double kModestReach = 32;
constexpr double kLargestReach = 0x1p20;
/// A result no farther away, in spacings, is not looked for any nearer.
constexpr double kNearEnough = 64;
/// Most features are joined within a small reach, so that the rest needs a wide one in few places only.
constexpr JoiningReach kGrowingReach = {8, kLargestReach};
constexpr JoiningReach kWideReach = {kLargestReach, kLargestReach};
/// On which lattices faces are thickened: before coarser grids, and at last.
constexpr ThickeningSteps kNearThickening = {4, 18, 2};
constexpr ThickeningSteps kFarThickening = {20, 60, 4};

/// The faces are kept if no vertices come together. Where they do, snap rounding is next; but on a grid of multiples,
/// which may be coarse, edges led round vertices may close a gap as wide as a triangle.
Result<bool> move_vertices(RoundingJob& job) {
  A3D_TRY(job.begin("moving vertices"));
  A3D_ASSIGN(const bool are_faces_kept, job.accept_moved());
  if (are_faces_kept || job.grid().is_floating()) return are_faces_kept;
  A3D_ASSIGN(const RoundingCandidate moved, with_moved_vertices(job.mesh(), job.vertices(), job.cancel()));
  return job.accept(moved);
}

/// True if a candidate was accepted, and no nearer one needs to be looked for.
bool is_near_enough(const RoundingJob& job) {
  return job.accepted_distance() <= kNearEnough * job.spacing();
}

/// Only solids have faces that can be thickened.
Result<bool> thicken(RoundingJob& job, const std::vector<bool>& crowded, const ThickeningSteps& steps) {
  return job.is_solid() ? thicken_faces(job, crowded, steps) : Result<bool>(false);
}

/// The rungs above snap rounding and dividing. Where most vertices are crowded, joining within wide reaches makes more
/// triangles cross than before; where few are, it may be nearer than thickened faces, and has fewer triangles.
Result<bool> join_or_thicken(RoundingJob& job, const RoundingCandidate& snapped) {
  A3D_ASSIGN(bool is_found, join_features(job, snapped, job.grid(), kGrowingReach));
  if (is_near_enough(job)) return true;
  A3D_ASSIGN(const std::vector<bool> crowded, crowded_vertices(job, snapped.mesh));
  if (!is_found) {
    A3D_ASSIGN(is_found, join_coplanar(job, crowded, kFirstReach, kModestReach));
  }
  const bool is_crowded = 2 * std::ranges::count(crowded, true) > std::ssize(crowded);
  if (!is_found && !is_crowded) {
    A3D_ASSIGN(is_found, join_features(job, snapped, job.grid(), kWideReach));
  }
  if (is_near_enough(job)) return true;
  A3D_ASSIGN(const bool is_thickened, thicken(job, crowded, kNearThickening));
  if (is_found || is_thickened) return true;
  if (is_crowded) {
    A3D_ASSIGN(is_found, join_features(job, snapped, job.grid(), kWideReach));
  }
  if (!is_found) {
    A3D_ASSIGN(is_found, join_coplanar(job, crowded, 4 * kModestReach, kLargestReach));
  }
  if (!is_found) {
    A3D_ASSIGN(is_found, round_to_coarser_grids(job));
  }
  return is_found ? Result<bool>(true) : thicken(job, crowded, kFarThickening);
}

}  // namespace

Result<bool> round_part(RoundingJob& job) {
  A3D_ASSIGN(const bool is_moved, move_vertices(job));
  if (is_moved) return true;
  A3D_TRY(job.begin("leading edges round vertices"));
  A3D_ASSIGN(const RoundingCandidate snapped, snap_rounded(job.mesh(), job.vertices(), job.cancel()));
  A3D_ASSIGN(const bool is_found, job.accept(snapped));
  return is_found || !job.grid().is_floating() ? Result<bool>(is_found)
                                               : join_features(job, snapped, job.grid(), {kModestReach, kModestReach});
}

// Where the grid may be coarse for the solid, dividing comes before joining; else it would only take time.
Result<bool> round_whole(RoundingJob& job) {
  A3D_ASSIGN(bool is_found, move_vertices(job));
  if (is_found) return true;
  A3D_TRY(job.begin("leading edges round vertices"));
  A3D_ASSIGN(const RoundingCandidate snapped, snap_rounded(job.mesh(), job.vertices(), job.cancel()));
  A3D_ASSIGN(is_found, job.accept(snapped));
  if (!is_found && !job.grid().is_floating()) {
    A3D_ASSIGN(const RoundingCandidate moved, with_moved_vertices(job.mesh(), job.vertices(), job.cancel()));
    A3D_ASSIGN(is_found, divide_at_crossings(job, moved));
  }
  return is_found ? Result<bool>(true) : join_or_thicken(job, snapped);
}

}  // namespace algebra3d
