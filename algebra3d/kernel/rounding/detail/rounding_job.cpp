#include "algebra3d/kernel/rounding/detail/rounding_job.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/rounding/detail/snap_rounding.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d {

FaceSet RoundingCandidate::kept_faces() const {
  std::vector<bool> are_kept;
  are_kept.reserve(kept.size());
  for (const std::uint32_t face : kept) are_kept.push_back(face != kNone);
  return FaceSet(std::move(are_kept));
}

RoundingCandidate with_its_faces(const TriangleMesh& mesh, const RoundedVertices& vertices) {
  RoundingCandidate candidate{TriangleMesh(mesh, vertices.points), Movement(rounded_up(vertices.largest_movement))};
  const std::vector<bool> moves = faces_that_move(mesh, vertices.movements);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) candidate.kept.push_back(moves[f] ? kNone : f);
  return candidate;
}

Result<RoundingCandidate> with_moved_vertices(const TriangleMesh& mesh, const RoundedVertices& vertices,
                                              const std::atomic<bool>* cancel) {
  A3D_ASSIGN(SnappedMesh moved, moved_mesh(mesh, vertices.points, cancel));
  return RoundingCandidate{std::move(moved.mesh),
                           Movement(rounded_up(vertices.largest_movement + moved.largest_detour))};
}

Result<RoundingCandidate> snap_rounded(const TriangleMesh& mesh, const RoundedVertices& vertices,
                                       const std::atomic<bool>* cancel) {
  A3D_ASSIGN(SnappedMesh snapped, snap_round(mesh, vertices, cancel));
  const RoundingMethod method =
      snapped.largest_detour > 0 ? RoundingMethod::edges_led_round : RoundingMethod::vertices_moved;
  return RoundingCandidate{std::move(snapped.mesh),
                           Movement(rounded_up(vertices.largest_movement + snapped.largest_detour)), 0, method};
}

// Far out multiples of a grid are denser than doubles.
RoundingJob::RoundingJob(const TriangleMesh& mesh, double size, const CoordinateGrid& grid, const Monitor& monitor)
    : mesh_(mesh),
      grid_(grid),
      size_(size),
      spacing_(std::max(grid.spacing_up_to(size), CoordinateGrid::doubles().spacing_up_to(size))),
      monitor_(monitor),
      vertices_(rounded_vertices(mesh, grid)) {}

Status RoundingJob::begin(const std::string& what) const {
  monitor_.tell("rounding: " + what);
  return monitor_.check();
}

Result<bool> RoundingJob::accept(const RoundingCandidate& candidate) {
  if (candidate.movement.distance >= accepted_distance_) return false;
  A3D_ASSIGN(const bool is_valid, prove(candidate));
  if (is_valid) accepted_distance_ = candidate.movement.distance;
  return is_valid;
}

Result<bool> RoundingJob::accept_moved() {
  A3D_ASSIGN(const std::optional<double> distance, prove_moved_vertices());
  if (distance) accepted_distance_ = *distance;
  return distance.has_value();
}

/// The limit: if a rounding has folded the mesh, all pairs may touch; that is hopeless.
Result<std::optional<TriangleMesh>> RoundingJob::divided(const TriangleMesh& mesh) const {
  return divided(mesh, 100 * mesh.face_count() + 100'000);
}

}  // namespace algebra3d
