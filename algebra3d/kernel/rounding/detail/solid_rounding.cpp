#include "algebra3d/kernel/rounding/detail/solid_rounding.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/autorefinement/winding_selection.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/met_cells.h"
#include "algebra3d/kernel/rounding/detail/rounding_rungs.h"
#include "algebra3d/kernel/rounding/detail/simpler_form.h"
#include "algebra3d/kernel/rounding/detail/triangle_stars.h"
#include "algebra3d/kernel/rounding/detail/vanishing.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// From so many faces on, a second task pays.
constexpr std::size_t kManyFaces = 5'000;

/// RoundingCandidate::kept for the mesh that was made of a candidate.
std::vector<std::uint32_t> still_kept(const RoundingCandidate& candidate, const TriangleStars& stars) {
  if (candidate.kept.empty()) return {};
  std::vector<std::uint32_t> kept = stars.unchanged();
  for (std::uint32_t& face : kept)
    if (face != kNone) face = candidate.kept[face];
  return kept;
}

}  // namespace

SolidRounding::SolidRounding(const TriangleMesh& solid, const SolidPart& part, const CoordinateGrid& grid,
                             const Monitor& monitor)
    : RoundingJob(part.mesh(), largest_coordinate(solid), grid, monitor), solid_(solid), part_(part) {
  if (vertices().are_finite) find_places_that_stay();
}

Result<std::optional<TriangleMesh>> SolidRounding::divided(const TriangleMesh& mesh, std::size_t max_pairs) const {
  const auto is_inside = [](int winding) { return winding > 0; };
  A3D_ASSIGN(const ValidParts parts, ValidParts::in_sheets(mesh, monitor()));
  auto cells = solid_by_winding(parts, is_inside, monitor(), {Closure::together, max_pairs});
  if (!cells.ok() && cells.error().code == ErrorCode::limit_exceeded) return std::optional<TriangleMesh>();
  if (!cells.ok()) return std::move(cells).error();
  return std::optional(*std::move(cells));
}

void SolidRounding::find_places_that_stay() {
  std::vector<bool> is_at_moved_face(mesh().vertex_count());
  for (const FaceId face : faces(mesh())) {
    const TriangleMesh::Triangle corners = mesh().triangle(face);
    if (std::ranges::any_of(corners, [&](std::uint32_t v) { return vertices().movements[v] > 0; }))
      for (const std::uint32_t v : corners) is_at_moved_face[v] = true;
  }
  places_that_stay_ = PointTable(mesh().vertex_count());
  for (std::size_t v = 0; v < mesh().vertex_count(); ++v)
    if (!is_at_moved_face[v]) places_that_stay_.intern(mesh().points()[v]);
}

Result<bool> SolidRounding::may_vanish(const RoundingCandidate& candidate) const {
  if (candidate.reach > kFirstReach * spacing()) return false;
  if (!is_whole()) return true;  // the rest stays
  // The displacement bounds the depth of a solid that vanished when its boundary was moved.
  A3D_ASSIGN(const bool has_cell, has_inner_cell(mesh(), grid(), candidate.movement.displacement, cancel()));
  return !has_cell;
}

Result<bool> SolidRounding::accept_as_it_is(const RoundingCandidate& candidate) {
  if (candidate.mesh.is_empty()) {
    A3D_ASSIGN(const bool may_be_empty, may_vanish(candidate));
    if (!may_be_empty) return false;
  }
  if (const auto change = part_.change_to(candidate.mesh, candidate.kept))
    return accept_in_place_of(change->part, change->added, {}, candidate);
  return accept_in_place_of(part_, candidate.mesh, candidate.kept_faces(), candidate);
}

Result<bool> SolidRounding::accept_in_place_of(const SolidPart& part, const TriangleMesh& added, const FaceSet& known,
                                               const RoundingCandidate& candidate) {
  // Nearly all candidates are valid, so the solid is made while that is proved.
  Result<ProofWithContacts> proof = ProofWithContacts{};
  bool keeps_shells = false;
  TriangleMesh solid;
  parallel_invoke(
      solid_.face_count() > kManyFaces,
      [&] { proof = part.prove_with(added, candidate.movement.displacement, known, cancel()); },
      [&] {
        keeps_shells = part.keeps_shells_with(added);
        solid = part.solid_with(added);
      });
  A3D_TRY(proof);
  if (!proof->is_valid) return false;
  if (!keeps_shells) result_.shells_before = connected_components(solid_).count;
  result_.mesh = std::move(solid);
  if (result_.shells_before > 0) result_.shells_after = connected_components(*result_.mesh).count;
  result_.contact_vertices = proof->contact_vertices;
  result_.largest_movement = candidate.movement.distance;
  result_.reach = candidate.reach;
  result_.method = candidate.method;
  return true;
}

Result<std::optional<RoundingCandidate>> SolidRounding::simplified(const RoundingCandidate& candidate) const {
  const double tolerance = superfluous_within(solid_, grid(), spacing());
  if (tolerance == 0) return std::optional<RoundingCandidate>();
  std::vector<bool> may_change;
  may_change.reserve(candidate.mesh.vertex_count());
  for (const Vec3& place : candidate.mesh.points().approx())
    may_change.push_back(places_that_stay_.find(place) == kNone);
  TriangleStars stars(candidate.mesh);
  A3D_ASSIGN(const bool is_simpler, make_simpler(stars, may_change, tolerance, cancel()));
  if (!is_simpler) return std::optional<RoundingCandidate>();
  const Movement movement = candidate.movement + Movement(rounded_up(2 * tolerance));
  return std::optional(
      RoundingCandidate{stars.mesh(), movement, candidate.reach, candidate.method, still_kept(candidate, stars)});
}

Result<bool> SolidRounding::prove(const RoundingCandidate& candidate) {
  A3D_ASSIGN(const std::optional<RoundingCandidate> simpler, simplified(candidate));
  if (simpler) {
    A3D_ASSIGN(const bool is_valid, accept_as_it_is(*simpler));
    if (is_valid) return true;
  }
  return accept_as_it_is(candidate);
}

Result<std::optional<double>> SolidRounding::prove_moved_vertices() {
  RoundedVertices all = rounded_vertices(solid_, grid());
  if (!are_apart(all)) return std::optional<double>();
  const double movement = rounded_up(all.largest_movement);
  const RoundingCandidate moved_part = with_its_faces(mesh(), vertices());
  A3D_ASSIGN(const std::optional<RoundingCandidate> simpler, simplified(moved_part));
  if (simpler) {
    A3D_ASSIGN(const bool is_valid, accept_as_it_is(*simpler));
    return is_valid && result_.contact_vertices == 0 ? std::optional(result_.largest_movement) : std::nullopt;
  }
  TriangleMesh moved(solid_, std::move(all.points));
  A3D_ASSIGN(const ProofWithContacts proof, prove_moved(solid_, moved, all.movements, movement, cancel()));
  if (!proof.is_valid || proof.contact_vertices > 0) return std::optional<double>();
  result_ = {std::move(moved), "", 0, movement, RoundingMethod::vertices_moved};
  return std::optional(movement);
}

Result<bool> SolidRounding::accept_cover() {
  A3D_ASSIGN(const std::optional<RoundingCandidate> cover,
             cover_of_cubes(mesh(), grid(), cell_budget(mesh()), cancel()));
  if (!cover) return false;
  A3D_ASSIGN(const bool is_valid, accept(*cover));
  if (!is_valid) return Error(ErrorCode::internal, "a cover of cubes is not valid");
  return true;
}

}  // namespace algebra3d
