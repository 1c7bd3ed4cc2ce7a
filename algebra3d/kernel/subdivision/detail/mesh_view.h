#pragma once

#include <cstdint>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "base/indices.h"

namespace algebra3d::subdivision {

/// A manifold mesh with plain numbers in place of handles. `kDegree` is the degree of all faces if the compiler is to
/// know it, so that faces are found without divisions; 0 for any degrees. Refers to the mesh.
template <std::uint32_t kDegree>
class MeshView {
 public:
  explicit MeshView(const PolygonMesh& mesh)
      : mesh_(&mesh), origins_(mesh.origins().data()), points_(mesh.points().approx().data()) {}

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(mesh_->vertex_count()); }
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(mesh_->face_count()); }
  std::uint32_t halfedge_count() const { return static_cast<std::uint32_t>(mesh_->halfedge_count()); }

  std::uint32_t face(std::uint32_t h) const {
    if constexpr (kDegree != 0) return h / kDegree;
    return mesh_->face(HalfedgeId(h)).index();
  }
  /// The first half-edge of a face.
  std::uint32_t first(std::uint32_t f) const {
    if constexpr (kDegree != 0) return f * kDegree;
    return mesh_->halfedge(FaceId(f)).index();
  }
  std::uint32_t degree(std::uint32_t f) const {
    if constexpr (kDegree != 0) return kDegree;
    return mesh_->degree(FaceId(f));
  }
  std::uint32_t next(std::uint32_t h) const {
    if constexpr (kDegree != 0) return h % kDegree == kDegree - 1 ? h - (kDegree - 1) : h + 1;
    return mesh_->next(HalfedgeId(h)).index();
  }
  std::uint32_t prev(std::uint32_t h) const {
    if constexpr (kDegree != 0) return h % kDegree == 0 ? h + (kDegree - 1) : h - 1;
    return mesh_->prev(HalfedgeId(h)).index();
  }
  /// kNone at the boundary.
  std::uint32_t opposite(std::uint32_t h) const { return mesh_->opposite(HalfedgeId(h)).index(); }
  bool is_boundary(std::uint32_t h) const { return opposite(h) == kNone; }
  bool is_first_of_edge(std::uint32_t h) const { return opposite(h) > h; }

  std::uint32_t origin(std::uint32_t h) const { return origins_[h]; }
  std::uint32_t target(std::uint32_t h) const { return origins_[next(h)]; }
  const Vec3& point(std::uint32_t v) const { return points_[v]; }
  const Vec3& origin_point(std::uint32_t h) const { return points_[origins_[h]]; }
  const Vec3& target_point(std::uint32_t h) const { return points_[target(h)]; }

  /// The half-edge that leaves `v` as PolygonMesh::outgoing says; kNone at an isolated vertex.
  std::uint32_t outgoing(std::uint32_t v) const { return mesh_->outgoing(VertexId(v)).index(); }
  /// Not for isolated vertices.
  bool is_boundary_vertex(std::uint32_t v) const { return is_boundary(outgoing(v)); }
  /// Calls visit(h) for the half-edges that leave a vertex, counter-clockwise from `start`, which must be its
  /// outgoing half-edge. Returns the last one.
  template <typename Visit>
  std::uint32_t for_each_outgoing(std::uint32_t start, const Visit& visit) const {
    std::uint32_t last = start;
    for (std::uint32_t h = start;;) {
      visit(h);
      last = h;
      h = opposite(prev(h));
      if (h == kNone || h == start) return last;
    }
  }
  /// The vertex before `v` along its boundary; the one after it is the target of its outgoing half-edge.
  std::uint32_t boundary_predecessor(std::uint32_t v) const {
    return origin(prev(for_each_outgoing(outgoing(v), [](std::uint32_t) {})));
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
