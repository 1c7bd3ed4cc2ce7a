#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/detail/height_fields.h"
#include "algebra3d/kernel/validity/face_set.h"

namespace algebra3d {

/// The vertices whose star is proved to be embedded: those inside a height field, and others by one sweep around the
/// vertex. That is so for nearly all vertices of nearly all meshes; for the others nothing is known.
///
/// `is_embedded(v)` means: no triangle at v is degenerate; no two of them have the same corners; and the intersection
/// of any two is exactly their common corner or common edge.
class EmbeddedStars {
 public:
  /// Tests all vertices.
  explicit EmbeddedStars(const TriangleMesh& mesh);
  /// Tests the vertices that are not inside a field; with `known`, of these only the corners of faces that are not in
  /// it, and others count as not embedded. Cost: linear, about 10 ns per corner tested.
  EmbeddedStars(const TriangleMesh& mesh, const HeightFields& fields, const FaceSet& known = {});

  bool is_embedded(VertexId v) const { return is_embedded_[v.index()] != 0; }
  /// True if a corner of the face is embedded; then the face is neither degenerate nor a duplicate.
  bool is_at_embedded(const TriangleMesh& mesh, FaceId face) const;

 private:
  template <typename IsAsked>
  void test(const TriangleMesh& mesh, const IsAsked& is_asked);

  std::vector<std::uint8_t> is_embedded_;
};

}  // namespace algebra3d
