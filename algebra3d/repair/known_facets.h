#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/exact/rational.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {

/// The facets of a file after the proof that it is no solid: which of them get along with each other, and the volume of
/// all. A repair leaves most of them as they are; they are recognised in what it made, so that this is proved, and its
/// volume summed up, with a look at the others alone. Immutable; concurrent reading is safe.
class KnownFacets {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// `mesh` has different points, all of doubles. `free` are faces of it that are a valid surface by themselves, as
  /// examine_volume finds them; `volume` is the exact_volume of all its faces.
  KnownFacets(std::shared_ptr<const TriangleMesh> mesh, const FaceSet& free, Rational volume);

  const std::shared_ptr<const TriangleMesh>& mesh() const { return mesh_; }
  const Rational& volume() const { return volume_; }

  /// Per face of `other`: the free face with the same corners, whichever way it looks; kNone if there is none.
  /// No face is named twice, and faces that have a point in common here have one vertex there: so those that are
  /// recognised are a valid surface in `other`, too. Exact: equal corners are equal doubles. Cost: linear.
  std::vector<std::uint32_t> recognise(const TriangleMesh& other) const;

  /// The exact_volume of `other`, whose faces were recognised. Cost: that of the sum over all faces that `other` or the
  /// facets have and not both. Errors: interrupted.
  Result<Rational> volume_of(const TriangleMesh& other, const std::vector<std::uint32_t>& recognised,
                             const std::atomic<bool>* cancel) const;

 private:
  /// A free face under its lowest corner.
  struct Entry {
    std::uint32_t middle, highest;  ///< the other corners
    std::uint32_t face;

    friend auto operator<=>(const Entry&, const Entry&) = default;
  };

  void list_by_lowest_corner(const FaceSet& free);
  std::uint32_t find(TriangleMesh::Triangle corners) const;
  std::vector<std::uint32_t> equal_points(const PointArray& others) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  Rational volume_;
  std::vector<std::uint32_t> starts_;  // per vertex, and one more: its first entry
  std::vector<Entry> entries_;         // ascending for each vertex
};

/// Those faces of the mesh that were recognised.
FaceSet recognised_faces(const std::vector<std::uint32_t>& recognised);

}  // namespace algebra3d
