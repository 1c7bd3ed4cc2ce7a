#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/face_set.h"
#include "algebra3d/kernel/validity/replacement.h"

namespace algebra3d {

/// The part of a solid that is rounded; the rest stays as it is. The solid must outlive this, and be valid where
/// something is proved of it.
class SolidPart {
 public:
  /// All of it.
  explicit SolidPart(const TriangleMesh& solid) : solid_(&solid) {}
  /// The faces with moved vertices, and those that share a vertex with them; all if that is more than half of them.
  /// `is_moved`: one flag per vertex. Cost: linear, a few nanoseconds per face.
  SolidPart(const TriangleMesh& solid, const std::vector<bool>& is_moved);

  struct Change;
  /// The smaller replacement if all faces of the part become those of `rounded`: the faces that do not stay, and those
  /// in their place. `kept` as in RoundingCandidate. Faces at an edge with more than two faces count as changed.
  /// Nothing if no face is known to stay, or if the part is the whole and more than a quarter changes: then the proof
  /// of the whole costs less. Cost: linear.
  std::optional<Change> change_to(const TriangleMesh& rounded, const std::vector<std::uint32_t>& kept) const;

  bool is_whole() const { return is_in_.empty(); }
  const TriangleMesh& mesh() const { return is_whole() ? *solid_ : part_; }

  /// Proves or refutes that the solid is valid with `rounded` in place of the part, which can be deformed into it so
  /// that no point moves farther than `movement`. `known`: faces of `rounded` that the solid has too, of which pairs
  /// are not tested again if the part is the whole. Exact. Errors: interrupted. Cost: that of a proof of the part, and
  /// a scan of the solid.
  Result<ProofWithContacts> prove_with(const TriangleMesh& rounded, double movement, const FaceSet& known,
                                       const std::atomic<bool>* cancel) const;
  /// False if the solid may have another number of shells with `rounded` in place of the part. Cost: linear in the
  /// part.
  bool keeps_shells_with(const TriangleMesh& rounded) const;
  /// The solid with `rounded` in place of the part.
  TriangleMesh solid_with(TriangleMesh rounded) const;

 private:
  /// The flagged faces.
  static SolidPart of_faces(const TriangleMesh& solid, std::vector<bool> is_in);
  /// The numbers in the solid of the part's faces.
  std::vector<FaceId> faces_of_solid() const;

  const TriangleMesh* solid_;
  std::vector<bool> is_in_;  // per face; empty: all
  TriangleMesh part_;
};

/// A part of a solid, and the faces that come in its place.
struct SolidPart::Change {
  SolidPart part;
  TriangleMesh added;
};

/// Proves or refutes a valid solid whose vertices have moved, with the faces that it had. `movements`: one number per
/// vertex, 0 if it stayed, in coordinate units; none moved farther than `largest`. Exact. Errors: interrupted. Cost:
/// that of a proof of the faces that moved, and a scan of the solid.
Result<ProofWithContacts> prove_moved(const TriangleMesh& solid, const TriangleMesh& moved,
                                      const std::vector<double>& movements, double largest,
                                      const std::atomic<bool>* cancel);

}  // namespace algebra3d
