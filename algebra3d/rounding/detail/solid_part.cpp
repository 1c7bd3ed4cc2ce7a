#include "algebra3d/rounding/detail/solid_part.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "algebra3d/base/indices.h"
#include "algebra3d/halfedge/replaced_faces.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"
#include "algebra3d/validity/validity.h"

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

Result<ProofWithContacts> prove_whole(const TriangleMesh& mesh, const std::atomic<bool>* cancel, FaceSet known = {}) {
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = cancel, .known = std::move(known)};
  ALGEBRA3D_ASSIGN_OR_RETURN(const ValidityReport report, prove_volume(mesh, options));
  return ProofWithContacts{report.is_valid(), report.contact_vertices};
}

}  // namespace

SolidPart::SolidPart(const TriangleMesh& solid, const std::vector<bool>& is_moved)
    : solid_(&solid), is_in_(solid.face_count()) {
  std::vector<bool> is_near = is_moved;
  for_each_face_at(solid, is_moved, [&](FaceId /*face*/, const TriangleMesh::Triangle& corners) {
    for (const std::uint32_t corner : corners) is_near[corner] = true;
  });
  std::vector<FaceId> faces;
  for_each_face_at(solid, is_near, [&](FaceId face, const TriangleMesh::Triangle& /*corners*/) {
    is_in_[face.index()] = true;
    faces.push_back(face);
  });
  if (faces.size() > solid.face_count() / 2)
    is_in_.clear();
  else
    part_ = submesh(solid, faces);
}

Result<ProofWithContacts> SolidPart::prove_with(const TriangleMesh& rounded, double movement,
                                                const std::atomic<bool>* cancel) const {
  return is_whole() ? prove_whole(rounded, cancel) : prove_replacement(*solid_, is_in_, rounded, movement, cancel);
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
