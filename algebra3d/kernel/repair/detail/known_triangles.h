#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/face_set.h"
#include "base/id_vector.h"

namespace algebra3d {

/// Per face of one mesh (the index): the face of another mesh with the same corners, or the invalid id. KnownTriangles
/// gives them per face of the mesh in which triangles are recognised.
using FaceMatches = IdVector<FaceId, FaceId>;

/// The triangles of a file, with the findings of their first proof: their *free* faces, which intersect no other face
/// (VolumeExamination), and their volume. A repair leaves most triangles unchanged. Free faces are recognised in its
/// result by their corners, so that later proofs need not compare them with each other again and volume sums need the
/// others only. With an empty `free` set nothing is recognised, and every proof tests everything again. Immutable;
/// concurrent reading is safe.
class KnownTriangles {
 public:
  /// `mesh` has distinct points with double coordinates. `free`: faces that are a valid surface by themselves, as
  /// examine_volume finds them; `volume`: the exact_volume of all faces, signed; it means nothing if they are not
  /// closed.
  KnownTriangles(std::shared_ptr<const TriangleMesh> mesh, const FaceSet& free, Rational volume);

  const std::shared_ptr<const TriangleMesh>& mesh() const { return mesh_; }
  const Rational& volume() const { return volume_; }

  /// Per face of `other`: the free face with the same corners, in either orientation. Each free face is used once, and
  /// faces that share a point here share a vertex in `other`; so the recognised faces are a valid surface there, too.
  /// Exact: equal corners are equal doubles. Cost: linear.
  FaceMatches recognise(const TriangleMesh& other) const;

  /// The exact_volume of `other`, given the recognised faces. Cost: that of the sum over the faces that only one mesh
  /// has. Errors: interrupted.
  Result<Rational> volume_of(const TriangleMesh& other, const FaceMatches& recognised,
                             const std::atomic<bool>* cancel) const;

 private:
  using Corners = std::array<VertexId, 3>;
  /// A free face, listed at its lowest corner.
  struct Entry {
    VertexId middle, highest;  ///< the other corners
    FaceId face;

    friend auto operator<=>(const Entry&, const Entry&) = default;
  };

  Corners sorted_corners(FaceId face) const;
  void list_by_lowest_corner(const FaceSet& free);
  FaceId find(Corners corners) const;
  IdVector<VertexId, VertexId> equal_points(const PointArray& others) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  Rational volume_;
  std::vector<std::uint32_t> starts_;  // per vertex: its first entry; one more at the end
  std::vector<Entry> entries_;         // ascending for each vertex
};

/// The faces of a mesh that were recognised.
FaceSet recognised_faces(const FaceMatches& recognised);

}  // namespace algebra3d
