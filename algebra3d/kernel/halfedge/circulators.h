#pragma once

#include <cstddef>

#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

/// The ranges of algebra3d/halfedge/circulators.h for the meshes of the kernel, and the edges of a mesh whose edges
/// have no numbers yet.
namespace algebra3d {
namespace circulators {

/// Walks over the half-edges that are the first along their edge.
template <typename Layout>
class EdgeCursor {
 public:
  using value_type = HalfedgeId;

  EdgeCursor() = default;
  EdgeCursor(const HalfedgeMesh<Layout>& mesh, std::size_t halfedge) : mesh_(&mesh), halfedge_(halfedge) { skip(); }

  HalfedgeId get() const { return HalfedgeId(halfedge_); }
  void advance() {
    ++halfedge_;
    skip();
  }
  bool operator==(const EdgeCursor& other) const { return halfedge_ == other.halfedge_; }

 private:
  void skip() {
    while (halfedge_ < mesh_->halfedge_count() && first_along(*mesh_, get()) != get()) ++halfedge_;
  }

  const HalfedgeMesh<Layout>* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
};

}  // namespace circulators

/// One half-edge per undirected edge, the first along it; ascending. Non-manifold edges are included.
template <typename Layout>
auto edges(const HalfedgeMesh<Layout>& mesh) {
  using Cursor = circulators::EdgeCursor<Layout>;
  return CursorRange<Cursor>(Cursor(mesh, 0), Cursor(mesh, mesh.halfedge_count()));
}

}  // namespace algebra3d
