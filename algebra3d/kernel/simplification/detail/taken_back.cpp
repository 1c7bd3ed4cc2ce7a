#include "algebra3d/kernel/simplification/detail/taken_back.h"

#include <algorithm>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Rounds after which everything is locked: the result is then the mesh itself.
constexpr std::size_t kMaxRounds = 24;

/// All faces: a shell may be on the wrong side because those around it moved.
std::vector<FaceId> all_faces(const TriangleMesh& mesh) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) faces.emplace_back(f);
  return faces;
}

/// Sets the flags of the neighbours of flagged vertices.
void grow(const TriangleMesh& mesh, std::vector<std::uint8_t>& flags) {
  const std::vector<std::uint8_t> before = flags;
  for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
    poll_interruption_at(h);
    const std::uint32_t a = mesh.origin(HalfedgeId(h)).index(), b = mesh.target(HalfedgeId(h)).index();
    flags[a] |= before[b];
    flags[b] |= before[a];
  }
}

}  // namespace

Result<std::vector<FaceId>> defects_of_surface(const TriangleMesh& mesh, const Monitor& monitor) {
  ProofOptions options;
  options.thoroughness = Thoroughness::first_defect;
  options.cancel = monitor.cancel();
  A3D_ASSIGN(const ValidityReport report, prove_surface(mesh, options));
  std::vector<FaceId> faces;
  if (report.is_valid()) return faces;
  A3D_ASSIGN(const std::vector<Entanglement> found, disentangle(mesh, monitor.cancel()));
  for (std::size_t f = 0; f < found.size(); ++f)
    if (found[f] != Entanglement::none) faces.emplace_back(f);
  return faces;
}

Result<std::vector<FaceId>> defects_of_volume(const TriangleMesh& mesh, const Monitor& monitor) {
  A3D_ASSIGN(const VolumeExamination examination, examine_volume(mesh, monitor.cancel()));
  std::vector<FaceId> faces;
  if (examination.report.is_valid()) return faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (!examination.free.contains(static_cast<std::uint32_t>(f))) faces.emplace_back(f);
  return faces.empty() ? all_faces(mesh) : faces;
}

void lock_around(const TriangleMesh& before, const TriangleMesh& after, std::span<const std::uint32_t> images,
                 std::span<const FaceId> defects, std::size_t round, std::vector<std::uint8_t>& locked) {
  const std::vector<std::uint8_t> old = locked;
  locked.resize(before.vertex_count(), 0);
  if (round >= kMaxRounds) {
    std::ranges::fill(locked, std::uint8_t{1});
    return;
  }
  std::vector<std::uint8_t> is_wrong(after.vertex_count(), 0);
  for (const FaceId f : defects)
    for (const std::uint32_t v : after.triangle(f)) is_wrong[v] = 1;
  std::vector<std::uint8_t> more(before.vertex_count(), 0);
  for (std::size_t v = 0; v < images.size(); ++v)
    if (images[v] != kNone && is_wrong[images[v]] != 0) more[v] = 1;
  for (std::size_t step = 0; step < round / 2; ++step) grow(before, more);
  for (std::size_t v = 0; v < more.size(); ++v) locked[v] |= more[v];
  // Only if the mesh itself is not valid.
  if (locked == old) std::ranges::fill(locked, std::uint8_t{1});
}

}  // namespace algebra3d
