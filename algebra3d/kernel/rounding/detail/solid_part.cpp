#include "algebra3d/kernel/rounding/detail/solid_part.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "algebra3d/kernel/halfedge/replaced_faces.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Calls visit(face, corners) for the faces with a flagged vertex.
template <typename Visit>
void for_each_face_at(const TriangleMesh& mesh, const std::vector<bool>& is_flagged, Visit visit) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleMesh::Triangle corners = mesh.triangle(FaceId(f));
    if (is_flagged[corners[0]] || is_flagged[corners[1]] || is_flagged[corners[2]]) visit(FaceId(f), corners);
  }
}

/// The shells of a mesh, and to which of them each edge of its boundary belongs.
class ShellsAtBoundary {
 public:
  explicit ShellsAtBoundary(const TriangleMesh& mesh) {
    const FaceComponents shells = connected_components(mesh);
    count_ = shells.count;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i)
      if (const HalfedgeId h(i); mesh.is_boundary(h))
        of_edges_.push_back({{mesh.point(mesh.origin(h)).approx, mesh.point(mesh.target(h)).approx},
                             shells.of_face[TriangleMesh::face(h).index()]});
    std::ranges::sort(of_edges_);
  }

  /// True if both have as many shells, with the same boundaries.
  bool are_as_in(const ShellsAtBoundary& other) const {
    if (count_ != other.count_ || of_edges_.size() != other.of_edges_.size()) return false;
    std::vector<std::uint32_t> theirs(count_, kNone), ours(count_, kNone);
    for (std::size_t i = 0; i < of_edges_.size(); ++i) {
      const auto& [edge, shell] = of_edges_[i];
      const auto& [other_edge, other_shell] = other.of_edges_[i];
      if (theirs[shell] == kNone && ours[other_shell] == kNone) {
        theirs[shell] = other_shell;
        ours[other_shell] = shell;
      }
      if (edge != other_edge || theirs[shell] != other_shell || ours[other_shell] != shell) return false;
    }
    return true;
  }

 private:
  std::size_t count_ = 0;
  std::vector<std::pair<std::pair<Vec3, Vec3>, std::uint32_t>> of_edges_;  // ascending
};

/// If less than one of so many faces of a solid changes, proving what changes is cheaper than proving the whole solid,
/// where pairs of faces that stay need no test. Measured: with two fifths it takes a third longer.
constexpr std::size_t kWholeByChanges = 4;

bool has_manifold_edges(const TriangleMesh& mesh, FaceId face) {
  const auto is_manifold = [&](std::uint32_t corner) {
    return !mesh.is_nonmanifold(TriangleMesh::halfedge(face, corner));
  };
  return is_manifold(0) && is_manifold(1) && is_manifold(2);
}

Result<ProofWithContacts> prove_whole(const TriangleMesh& mesh, const std::atomic<bool>* cancel, FaceSet known) {
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = cancel, .known = std::move(known)};
  A3D_ASSIGN(const ValidityReport report, prove_volume(mesh, options));
  return ProofWithContacts{report.is_valid(), report.contact_vertices};
}

}  // namespace

SolidPart::SolidPart(const TriangleMesh& solid, const std::vector<bool>& is_moved) : solid_(&solid) {
  std::vector<bool> is_near = is_moved, is_in(solid.face_count());
  for_each_face_at(solid, is_moved, [&](FaceId /*face*/, const TriangleMesh::Triangle& corners) {
    for (const std::uint32_t corner : corners) is_near[corner] = true;
  });
  std::size_t count = 0;
  for_each_face_at(solid, is_near, [&](FaceId face, const TriangleMesh::Triangle& /*corners*/) {
    is_in[face.index()] = true;
    ++count;
  });
  if (count <= solid.face_count() / 2) *this = of_faces(solid, std::move(is_in));
}

SolidPart SolidPart::of_faces(const TriangleMesh& solid, std::vector<bool> is_in) {
  SolidPart result(solid);
  result.is_in_ = std::move(is_in);
  result.part_ = submesh(solid, result.faces_of_solid());
  return result;
}

std::vector<FaceId> SolidPart::faces_of_solid() const {
  std::vector<FaceId> result;
  for (std::uint32_t f = 0; f < solid_->face_count(); ++f)
    if (is_whole() || is_in_[f]) result.emplace_back(f);
  return result;
}

std::optional<SolidPart::Change> SolidPart::change_to(const TriangleMesh& rounded,
                                                      const std::vector<std::uint32_t>& kept) const {
  if (kept.empty()) return std::nullopt;
  const std::vector<FaceId> faces = faces_of_solid();
  std::vector<bool> changes = is_whole() ? std::vector<bool>(solid_->face_count(), true) : is_in_;
  std::vector<FaceId> added;
  for (std::uint32_t f = 0; f < kept.size(); ++f) {
    if (kept[f] != kNone && has_manifold_edges(*solid_, faces[kept[f]]))
      changes[faces[kept[f]].index()] = false;
    else
      added.emplace_back(f);
  }
  const std::size_t most = solid_->face_count() / (is_whole() ? kWholeByChanges : 2);
  if (added.size() > most || static_cast<std::size_t>(std::ranges::count(changes, true)) > most) return std::nullopt;
  return Change{of_faces(*solid_, std::move(changes)), submesh(rounded, added)};
}

Result<ProofWithContacts> SolidPart::prove_with(const TriangleMesh& rounded, double movement, const FaceSet& known,
                                                const std::atomic<bool>* cancel) const {
  return is_whole() ? prove_whole(rounded, cancel, known)
                    : prove_replacement(*solid_, is_in_, rounded, movement, cancel);
}

bool SolidPart::keeps_shells_with(const TriangleMesh& rounded) const {
  const ShellsAtBoundary before(mesh()), after(rounded);
  return before.are_as_in(after);
}

TriangleMesh SolidPart::solid_with(TriangleMesh rounded) const {
  return is_whole() ? std::move(rounded) : with_replaced_faces(*solid_, is_in_, rounded);
}

Result<ProofWithContacts> prove_moved(const TriangleMesh& solid, const TriangleMesh& moved,
                                      const std::vector<double>& movements, double largest,
                                      const std::atomic<bool>* cancel) {
  std::vector<bool> is_moved = faces_that_move(solid, movements);
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < solid.face_count(); ++f)
    if (is_moved[f]) faces.emplace_back(f);
  if (faces.size() > solid.face_count() / 2) {
    is_moved.flip();
    return prove_whole(moved, cancel, FaceSet(std::move(is_moved)));
  }
  return prove_replacement(solid, is_moved, submesh(moved, faces), largest, cancel);
}

}  // namespace algebra3d
