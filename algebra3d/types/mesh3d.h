#pragma once

#include <memory>

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/polygon_mesh.h"
#include "algebra3d/types/value.h"

namespace algebra3d {

/// mesh3d: vertices with exact coordinates and faces of three or more corners; any such lists are a value: faces may be
/// bent, may cross, and may be non-manifold. Vertices and faces are numbered from 0 in their order. Two values are
/// equal if they have the same vertices and faces in the same order. Immutable, cheap to copy.
class Mesh3d {
 public:
  Mesh3d();  ///< the empty mesh
  /// Each face must have at least three corners (asserted). Cost: linear.
  explicit Mesh3d(PolygonMesh mesh);

  const PolygonMesh& mesh() const { return content_->mesh; }
  /// The smallest box of doubles around all vertices.
  const Box3& box() const { return content_->box; }

 private:
  struct Content {
    PolygonMesh mesh;
    Box3 box;
  };
  std::shared_ptr<const Content> content_;
};

template <>
struct TypeOf<Mesh3d> {
  static const Type& type();
};

}  // namespace algebra3d
