#include "algebra3d/kernel/validity/validity.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/validity/contacts.h"
#include "algebra3d/kernel/validity/detail/edges.h"
#include "algebra3d/kernel/validity/detail/intersections.h"
#include "algebra3d/kernel/validity/detail/proved_parts.h"
#include "algebra3d/kernel/validity/detail/triangles.h"
#include "algebra3d/kernel/validity/detail/winding.h"
#include "algebra3d/kernel/validity/limited_proof.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

enum class Kind : std::uint8_t { surface, volume };

Status check_cancelled(const ProofOptions& options) {
  if (options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed))
    return Error{ErrorCode::interrupted, "interrupted"};
  return {};
}

/// From so many faces on, the hierarchy is built at the same time as parts are proved.
constexpr std::size_t kManyFaces = 10'000;

std::vector<std::uint32_t> list_of(const SoundFaces& sound) {
  std::vector<std::uint32_t> faces;
  faces.reserve(sound.size());
  for (std::uint32_t face = 0; face < sound.size(); ++face)
    if (sound[face]) faces.push_back(face);
  return faces;
}

Result<ShellWindings> find_windings(const TriangleMesh& mesh, const HeightFields& fields, const BoxHierarchy& hierarchy,
                                    const ProofOptions& options) {
  if (options.preimage.mesh == nullptr) return find_shell_windings(mesh, fields, hierarchy, options.cancel);
  return find_shell_windings(mesh, fields, options.preimage, hierarchy, options.cancel);
}

Status check_windings(const TriangleMesh& mesh, const HeightFields& fields, const BoxHierarchy& hierarchy,
                      const ProofOptions& options, ValidityReport& report) {
  A3D_ASSIGN(const ShellWindings shells, find_windings(mesh, fields, hierarchy, options));
  for (std::size_t shell = 0; shell < shells.fronts.size(); ++shell) {
    if (shells.fronts[shell] == 0) continue;
    const FaceId face(shells.first_faces[shell]);
    report.add({Defect::wrong_winding, face, FaceId(), mesh.corners(face)[0].approx});
  }
  return {};
}

BoxHierarchy hierarchy_for_pairs(const TriangleMesh& mesh, const SoundFaces& sound, const Preimage& preimage) {
  if (preimage.mesh == nullptr) return {mesh, list_of(sound)};
  assert(preimage.mesh->face_count() == mesh.face_count());
  return {*preimage.mesh, list_of(sound), preimage.reach / 2};
}

/// Leaves in `free` the faces that get along with each other, unless it is empty. `limit`: of the search for pairs.
Result<ValidityReport> prove(const TriangleMesh& mesh, Kind kind, const ProofOptions& options, FaceSet& free,
                             ExactWorkLimit* limit = nullptr) {
  ValidityReport report;
  const auto is_done = [&] { return options.thoroughness == Thoroughness::first_defect && !report.is_valid(); };
  std::optional<ProvedParts> proved;
  std::optional<BoxHierarchy> hierarchy;
  const SoundFaces all(mesh.face_count(), true);
  const bool is_large = mesh.face_count() > kManyFaces;
  parallel_invoke(
      is_large, [&] { proved.emplace(mesh, options.known); },
      [&] {
        if (is_large) hierarchy.emplace(hierarchy_for_pairs(mesh, all, options.preimage));
      });
  A3D_TRY(check_cancelled(options));
  const SoundFaces sound = check_triangles(mesh, *proved, report);
  if (!free.is_empty()) free = FaceSet(sound);
  if (is_done()) return report;
  if (kind == Kind::volume) check_edges(mesh, sound, report);
  if (is_done()) return report;
  A3D_TRY(check_cancelled(options));
  if (!hierarchy || sound != all) hierarchy.emplace(hierarchy_for_pairs(mesh, sound, options.preimage));
  A3D_ASSIGN(const FacePairs touching, find_intersections(mesh, *proved, *hierarchy, options, report, free, limit));
  // Off the beaten track a winding number means nothing.
  if (kind == Kind::volume && report.is_valid())
    A3D_TRY(check_windings(mesh, proved->fields, *hierarchy, options, report));
  if (report.is_valid()) report.contact_vertices = vertex_count_of(vertex_contacts(mesh, touching));
  return report;
}

}  // namespace

Result<Crossings> find_crossings(const TriangleMesh& mesh, const std::atomic<bool>* cancel) {
  ValidityReport ignored;
  const FaceSet none_known;
  const ProvedParts proved(mesh, none_known);
  const SoundFaces sound = check_triangles(mesh, proved, ignored);
  Crossings crossings;
  for (const FaceId face : faces(mesh)) {
    if (sound[face.index()]) continue;
    const TriangleRef corners = mesh.corners(face);
    if (!collinear(corners[0], corners[1], corners[2])) crossings.duplicates.push_back(face);
  }
  BoxHierarchy hierarchy(mesh, list_of(sound));
  const auto touching = for_each_intersection(mesh, proved, hierarchy, cancel, [&](FaceId first, FaceId second) {
    crossings.pairs.emplace_back(first, second);
    return true;
  });
  A3D_TRY(touching);
  std::ranges::sort(crossings.pairs);
  return crossings;
}

Result<std::vector<Entanglement>> disentangle(const TriangleMesh& mesh, const std::atomic<bool>* cancel,
                                              const FaceSet& known, AllowedEdges edges) {
  ValidityReport ignored;
  const ProvedParts proved(mesh, known);
  const SoundFaces sound = check_triangles(mesh, proved, ignored);
  std::vector<Entanglement> result(mesh.face_count(), Entanglement::none);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const TriangleRef corners = mesh.corners(FaceId(f));
    if (!sound[f])
      result[f] = collinear(corners[0], corners[1], corners[2]) ? Entanglement::degenerate : Entanglement::entangled;
    for (std::uint32_t corner = 0; corner < 3 && edges == AllowedEdges::manifold; ++corner)
      if (sound[f] && !mesh.opposite(TriangleMesh::halfedge(FaceId(f), corner)).is_valid())
        result[f] = Entanglement::entangled;
  }
  BoxHierarchy hierarchy(mesh, list_of(sound));
  const auto part_from_first = [&](FaceId first, FaceId second) {
    if (result[first.index()] == Entanglement::none) result[second.index()] = Entanglement::entangled;
    return true;
  };
  const auto touching = for_each_intersection(mesh, proved, hierarchy, cancel, part_from_first);
  A3D_TRY(touching);
  return result;
}

Result<ValidityReport> prove_surface(const TriangleMesh& mesh, const ProofOptions& options) {
  FaceSet ignored;
  return prove(mesh, Kind::surface, options, ignored);
}

Result<ValidityReport> prove_surface(const TriangleMesh& mesh, const ProofOptions& options, ExactWorkLimit& limit) {
  FaceSet ignored;
  return prove(mesh, Kind::surface, options, ignored, &limit);
}

Result<ValidityReport> prove_volume(const TriangleMesh& mesh, const ProofOptions& options) {
  FaceSet ignored;
  return prove(mesh, Kind::volume, options, ignored);
}

Result<VolumeExamination> examine_volume(const TriangleMesh& mesh, const std::atomic<bool>* cancel) {
  VolumeExamination result{{}, FaceSet(std::vector<bool>(mesh.face_count(), true))};
  A3D_ASSIGN(result.report, prove(mesh, Kind::volume, {.cancel = cancel}, result.free));
  // Of pairs that were not met nothing is known.
  if (result.report.is_cut_short) result.free = {};
  return result;
}

}  // namespace algebra3d
