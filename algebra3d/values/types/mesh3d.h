#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/vertex_facts.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// mesh3d: vertices with exact coordinates and faces of three or more corners; any such lists are a value: faces may be
/// bent, may cross, and may be non-manifold. Vertices and faces are numbered from 0 in their order. Elements may have
/// named attributes. Two values are equal if they have the same vertices and faces in the same order, and the same
/// attributes. Immutable, cheap to copy.
class Mesh3d {
 public:
  Mesh3d();  ///< the empty mesh
  /// Each face must have at least three corners (asserted). Cost: linear.
  explicit Mesh3d(PolygonMesh mesh);
  /// The attributes must have a value for each element (asserted).
  Mesh3d(PolygonMesh mesh, MeshAttributes attributes);
  /// The mesh, which is shared, with other attributes.
  Mesh3d with_attributes(MeshAttributes attributes) const;

  const PolygonMesh& mesh() const { return content_->mesh; }
  const MeshAttributes& attributes() const { return attributes_; }
  /// The smallest box of doubles around all vertices.
  const Box3& box() const { return content_->box; }
  /// The numbers of the edges, found at the first call, by any thread. Cost: linear at the first call.
  const EdgeNumbers& edge_numbers() const;
  const HubFacts& hub_facts() const { return content_->hub_facts; }

 private:
  struct Content {
    PolygonMesh mesh;
    Box3 box;
    mutable std::once_flag once = {};
    mutable EdgeNumbers edge_numbers = {};
    HubFacts hub_facts = {};

    Content() = default;
    Content(PolygonMesh polygons, const Box3& bounds) : mesh(std::move(polygons)), box(bounds) {}
  };
  std::shared_ptr<const Content> content_;
  MeshAttributes attributes_;
};

template <>
struct TypeOf<Mesh3d> {
  static const Type& type();
};

}  // namespace algebra3d
