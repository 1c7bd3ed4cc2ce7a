#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "algebra3d/kernel/halfedge/detail/cursor_range.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

/// Neighbourhoods and elements of a mesh as lazy ranges: forward (all elements of a kind: random access), without
/// allocation, for use with std::views. Iterators may outlive their range but not the mesh. Handles that are passed
/// must be valid in the mesh.
///
/// Around a vertex the order is counter-clockwise, fan by fan in the order of `TriangleMesh::fans`; each fan starts at
/// its first half-edge. All fans of a non-manifold vertex are included; an isolated vertex has empty neighbourhoods.
namespace algebra3d {
namespace circulators {

/// Walks over the half-edges that leave a vertex.
template <typename Layout>
class CornerCursor {
 public:
  using value_type = HalfedgeId;

  CornerCursor() = default;
  /// The first half-edge of `fans`.
  CornerCursor(const HalfedgeMesh<Layout>& mesh, std::span<const HalfedgeId> fans)
      : mesh_(&mesh), fan_(fans.data()), fans_end_(fans.data() + fans.size()) {
    enter_fan();
  }

  HalfedgeId get() const { return current_; }
  void advance() {
    const HalfedgeId next = next_in_fan();
    if (next.is_valid() && next != *fan_) {
      current_ = next;
    } else {
      ++fan_;
      enter_fan();
    }
  }
  bool operator==(const CornerCursor& other) const { return fan_ == other.fan_ && current_ == other.current_; }

  HalfedgeId next_in_fan() const { return mesh_->opposite(mesh_->prev(current_)); }
  const HalfedgeMesh<Layout>& mesh() const { return *mesh_; }

 private:
  void enter_fan() { current_ = fan_ == fans_end_ ? HalfedgeId() : *fan_; }

  const HalfedgeMesh<Layout>* mesh_ = nullptr;
  const HalfedgeId* fan_ = nullptr;
  const HalfedgeId* fans_end_ = nullptr;
  HalfedgeId current_;
};

template <typename Layout>
struct FaceCursor : CornerCursor<Layout> {
  using value_type = FaceId;
  using CornerCursor<Layout>::CornerCursor;
  FaceId get() const { return this->mesh().face(CornerCursor<Layout>::get()); }
};

/// Walks over the neighbours of a vertex: the target of each outgoing half-edge, and in an open fan the origin of the
/// last incoming one.
template <typename Layout>
class NeighbourCursor {
 public:
  using value_type = VertexId;

  NeighbourCursor() = default;
  NeighbourCursor(const HalfedgeMesh<Layout>& mesh, std::span<const HalfedgeId> fans)
      : mesh_(&mesh), corner_(mesh, fans) {}

  VertexId get() const {
    const HalfedgeId h = corner_.get();
    return at_last_incoming_ ? mesh_->origin(mesh_->prev(h)) : mesh_->target(h);
  }
  void advance() {
    at_last_incoming_ = !at_last_incoming_ && !corner_.next_in_fan().is_valid();
    if (!at_last_incoming_) corner_.advance();
  }
  bool operator==(const NeighbourCursor& other) const {
    return corner_ == other.corner_ && at_last_incoming_ == other.at_last_incoming_;
  }

 private:
  const HalfedgeMesh<Layout>* mesh_ = nullptr;
  CornerCursor<Layout> corner_;
  bool at_last_incoming_ = false;
};

/// Walks over the faces along the edges of a face: those of the other half-edges.
template <typename Layout>
class AdjacentFaceCursor {
 public:
  using value_type = FaceId;

  AdjacentFaceCursor() = default;
  AdjacentFaceCursor(const HalfedgeMesh<Layout>& mesh, std::size_t halfedge, std::size_t end)
      : mesh_(&mesh), halfedge_(halfedge), end_(end) {
    skip();
  }

  FaceId get() const { return mesh_->face(other()); }
  void advance() {
    ++place_;
    skip();
  }
  bool operator==(const AdjacentFaceCursor& rhs) const { return halfedge_ == rhs.halfedge_ && place_ == rhs.place_; }

 private:
  /// The half-edge at place_ along the edge of halfedge_; invalid past the last.
  HalfedgeId other() const {
    const HalfedgeId h(halfedge_);
    if (!mesh_->is_nonmanifold(h)) return place_ == 0 ? mesh_->opposite(h) : HalfedgeId();
    const auto along = mesh_->edge_halfedges(h);
    return place_ < along.size() ? along[place_] : HalfedgeId();
  }
  void skip() {
    for (; halfedge_ != end_; ++halfedge_, place_ = 0) {
      for (HalfedgeId h = other(); h.is_valid(); ++place_, h = other())
        if (mesh_->face(h) != mesh_->face(HalfedgeId(halfedge_))) return;
    }
  }

  const HalfedgeMesh<Layout>* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
  std::size_t end_ = 0;
  std::size_t place_ = 0;
};

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
  bool is_first() const {
    const HalfedgeId h(halfedge_);
    return mesh_->is_nonmanifold(h) ? mesh_->edge_halfedges(h).front() == h : !(mesh_->opposite(h) < h);
  }
  void skip() {
    while (halfedge_ < mesh_->halfedge_count() && !is_first()) ++halfedge_;
  }

  const HalfedgeMesh<Layout>* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
};

/// Walks over the origins of half-edges by index.
template <typename Layout>
class OriginCursor {
 public:
  using value_type = VertexId;

  OriginCursor() = default;
  OriginCursor(const HalfedgeMesh<Layout>& mesh, std::size_t halfedge) : mesh_(&mesh), halfedge_(halfedge) {}

  VertexId get() const { return mesh_->origin(HalfedgeId(halfedge_)); }
  void advance() { ++halfedge_; }
  bool operator==(const OriginCursor& other) const { return halfedge_ == other.halfedge_; }

 private:
  const HalfedgeMesh<Layout>* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
};

template <typename Cursor, typename Layout>
CursorRange<Cursor> around(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  const auto fans = mesh.fans(v);
  return {Cursor(mesh, fans), Cursor(mesh, fans.subspan(fans.size()))};
}

/// The numbers of the half-edges of a face: the first, and the end.
template <typename Layout>
std::pair<std::size_t, std::size_t> halfedge_bounds(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  const std::size_t first = mesh.halfedge(f).index();
  return {first, first + mesh.degree(f)};
}

}  // namespace circulators

/// Half-edges that leave `v`, one per corner at `v`.
template <typename Layout>
auto outgoing_halfedges(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  return circulators::around<circulators::CornerCursor<Layout>>(mesh, v);
}
/// Faces with a corner at `v`; a face that repeats a corner appears once per corner at `v`.
template <typename Layout>
auto faces_around(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  return circulators::around<circulators::FaceCursor<Layout>>(mesh, v);
}
/// One-ring of `v`: the other end of each edge at `v`, each once; across a non-manifold edge once per side of a fan
/// that the edge bounds.
template <typename Layout>
auto adjacent_vertices(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  return circulators::around<circulators::NeighbourCursor<Layout>>(mesh, v);
}

/// The half-edges of `f`, from corner 0.
template <typename Layout>
HandleRange<HalfedgeId> halfedges_of(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  const auto [first, end] = circulators::halfedge_bounds(mesh, f);
  return {first, end};
}
/// The corners of `f`, from corner 0.
template <typename Layout>
auto vertices_of(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  using Cursor = circulators::OriginCursor<Layout>;
  const auto [first, end] = circulators::halfedge_bounds(mesh, f);
  return CursorRange<Cursor>(Cursor(mesh, first), Cursor(mesh, end));
}
/// Faces that share an edge with `f`, without `f`: edge by edge from half-edge 0; across a non-manifold edge all other
/// faces, ascending. A face that shares two edges appears twice.
template <typename Layout>
auto adjacent_faces(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  using Cursor = circulators::AdjacentFaceCursor<Layout>;
  const auto [first, end] = circulators::halfedge_bounds(mesh, f);
  return CursorRange<Cursor>(Cursor(mesh, first, end), Cursor(mesh, end, end));
}

/// All elements, ascending. Random access.
template <typename Layout>
HandleRange<VertexId> vertices(const HalfedgeMesh<Layout>& mesh) {
  return {0, mesh.vertex_count()};
}
template <typename Layout>
HandleRange<FaceId> faces(const HalfedgeMesh<Layout>& mesh) {
  return {0, mesh.face_count()};
}
template <typename Layout>
HandleRange<HalfedgeId> halfedges(const HalfedgeMesh<Layout>& mesh) {
  return {0, mesh.halfedge_count()};
}
/// One half-edge per undirected edge, the first along it; ascending. Non-manifold edges are included.
template <typename Layout>
auto edges(const HalfedgeMesh<Layout>& mesh) {
  using Cursor = circulators::EdgeCursor<Layout>;
  return CursorRange<Cursor>(Cursor(mesh, 0), Cursor(mesh, mesh.halfedge_count()));
}

}  // namespace algebra3d
