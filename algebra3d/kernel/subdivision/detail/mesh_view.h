#pragma once

#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "base/indices.h"

namespace algebra3d::subdivision {

/// A manifold mesh whose points are doubles. `kDegree` is the degree of all faces if the compiler is to
/// know it, so that faces are found without divisions; 0 for any degrees. Refers to the mesh.
template <unsigned kDegree>
class MeshView {
 public:
  explicit MeshView(const PolygonMesh& mesh)
      : mesh_(&mesh), origins_(mesh.origins().data()), points_(mesh.points().approx().data()) {}

  std::size_t vertex_count() const { return mesh_->vertex_count(); }
  std::size_t face_count() const { return mesh_->face_count(); }
  std::size_t halfedge_count() const { return mesh_->halfedge_count(); }

  FaceId face(HalfedgeId h) const {
    if constexpr (kDegree != 0) return FaceId(h.index() / kDegree);
    return mesh_->face(h);
  }
  /// The first half-edge of a face.
  HalfedgeId first(FaceId f) const {
    if constexpr (kDegree != 0) return HalfedgeId(f.index() * kDegree);
    return mesh_->halfedge(f);
  }
  /// All half-edges of a face.
  IdRange<HalfedgeId> halfedges_of(FaceId f) const {
    const HalfedgeId start = first(f);
    return {start, HalfedgeId(start.index() + degree(f))};
  }
  unsigned degree(FaceId f) const {
    if constexpr (kDegree != 0) return kDegree;
    return mesh_->degree(f);
  }
  HalfedgeId next(HalfedgeId h) const {
    if constexpr (kDegree != 0)
      return HalfedgeId(h.index() % kDegree == kDegree - 1 ? h.index() - (kDegree - 1) : h.index() + 1);
    return mesh_->next(h);
  }
  HalfedgeId prev(HalfedgeId h) const {
    if constexpr (kDegree != 0) return HalfedgeId(h.index() % kDegree == 0 ? h.index() + (kDegree - 1) : h.index() - 1);
    return mesh_->prev(h);
  }
  /// None at the boundary.
  HalfedgeId opposite(HalfedgeId h) const { return mesh_->opposite(h); }
  bool is_boundary(HalfedgeId h) const { return opposite(h).is_none(); }
  bool is_first_of_edge(HalfedgeId h) const { return opposite(h) > h; }

  VertexId origin(HalfedgeId h) const { return VertexId(origins_[h.index()]); }
  VertexId target(HalfedgeId h) const { return origin(next(h)); }
  const Vec3& point(VertexId v) const { return points_[v.index()]; }
  const Vec3& origin_point(HalfedgeId h) const { return point(origin(h)); }
  const Vec3& target_point(HalfedgeId h) const { return point(target(h)); }

  /// The half-edge that leaves `v` as PolygonMesh::outgoing says; none at an isolated vertex.
  HalfedgeId outgoing(VertexId v) const { return mesh_->outgoing(v); }
  /// Not for isolated vertices.
  bool is_boundary_vertex(VertexId v) const { return is_boundary(outgoing(v)); }
  /// Calls visit(h) for the half-edges that leave a vertex, counter-clockwise from `start`, which must be its
  /// outgoing half-edge. Returns the last one.
  template <typename Visit>
  HalfedgeId for_each_outgoing(HalfedgeId start, const Visit& visit) const {
    HalfedgeId last = start;
    for (HalfedgeId h = start;;) {
      visit(h);
      last = h;
      h = opposite(prev(h));
      if (h.is_none() || h == start) return last;
    }
  }
  /// The vertex before `v` along its boundary; the one after it is the target of its outgoing half-edge.
  VertexId boundary_predecessor(VertexId v) const {
    return origin(prev(for_each_outgoing(outgoing(v), [](HalfedgeId) {})));
  }

 private:
  const PolygonMesh* mesh_;
  const std::uint32_t* origins_;
  const Vec3* points_;
};

/// Calls visit(view) with the view that knows most.
template <typename Visit>
auto with_view(const PolygonMesh& mesh, const Visit& visit) {
  switch (mesh.common_degree()) {
    case 3:
      return visit(MeshView<3>(mesh));
    case 4:
      return visit(MeshView<4>(mesh));
    default:
      return visit(MeshView<0>(mesh));
  }
}

}  // namespace algebra3d::subdivision
