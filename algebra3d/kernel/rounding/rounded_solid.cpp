#include "algebra3d/kernel/rounding/rounded_solid.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/rounding/detail/remaining_distance.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/rounding/detail/rounding_ladder.h"
#include "algebra3d/kernel/rounding/detail/solid_part.h"
#include "algebra3d/kernel/rounding/detail/solid_rounding.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The rounded solid: of a part of it, or else of the whole.
Result<RoundedSolid> climbed(const TriangleMesh& solid, const SolidPart& part, const CoordinateGrid& grid,
                             const Monitor& monitor) {
  SolidRounding job(solid, part, grid, monitor);
  if (!job.vertices().are_finite) return RoundedSolid{std::nullopt, out_of_range_text(job.size(), grid)};
  A3D_ASSIGN(const bool is_found, climb_ladder(job));
  if (is_found) return job.result();
  if (!part.is_whole()) return climbed(solid, SolidPart(solid), grid, monitor);
  return RoundedSolid{std::nullopt, out_of_range_text(job.size(), job.grid())};
}

}  // namespace

std::string shells_text(const RoundedSolid& rounded) {
  const auto shells = [](std::size_t count) { return fmt::format("{} shell{}", count, count == 1 ? "" : "s"); };
  return fmt::format("{} instead of {}: some vanished or merged", shells(rounded.shells_after), rounded.shells_before);
}

Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid, const Monitor& monitor) {
  const std::vector<bool> is_moved = are_moved(solid, grid);
  const auto moved_count = static_cast<std::size_t>(std::ranges::count(is_moved, true));
  if (moved_count == 0) return RoundedSolid{solid};
  A3D_ASSIGN(RoundedSolid rounded, climbed(solid, SolidPart(solid, is_moved), grid, monitor));
  rounded.moved_vertices = moved_count;
  if (rounded.mesh && rounded.shells_after < rounded.shells_before) {
    A3D_ASSIGN(rounded.largest_movement,
               remaining_distance(solid, *rounded.mesh, grid, rounded.largest_movement, monitor));
  }
  return rounded;
}

}  // namespace algebra3d
