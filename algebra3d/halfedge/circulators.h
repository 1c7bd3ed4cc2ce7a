#pragma once

#include <cstddef>
#include <ranges>
#include <span>

#include "algebra3d/halfedge/detail/cursor_range.h"
#include "algebra3d/halfedge/triangle_mesh.h"

/// Neighbourhoods and elements of a mesh as lazy ranges: forward (all elements of a kind: random access), without
/// allocation, for use with std::views. Iterators may outlive their range but not the mesh. Handles that are passed
/// must be valid in the mesh.
///
/// Around a vertex the order is counter-clockwise, fan by fan in the order of `TriangleMesh::fans`; each fan starts at
/// its first half-edge. All fans of a non-manifold vertex are included; an isolated vertex has empty neighbourhoods.
namespace algebra3d {
namespace circulators {

/// Walks over the half-edges that leave a vertex.
class CornerCursor {
 public:
  using value_type = HalfedgeId;

  CornerCursor() = default;
  /// The first half-edge of `fans`.
  CornerCursor(const TriangleMesh& mesh, std::span<const HalfedgeId> fans)
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

  HalfedgeId next_in_fan() const { return mesh_->opposite(TriangleMesh::prev(current_)); }

 private:
  void enter_fan() { current_ = fan_ == fans_end_ ? HalfedgeId() : *fan_; }

  const TriangleMesh* mesh_ = nullptr;
  const HalfedgeId* fan_ = nullptr;
  const HalfedgeId* fans_end_ = nullptr;
  HalfedgeId current_;
};

struct IncomingCursor : CornerCursor {
  using CornerCursor::CornerCursor;
  HalfedgeId get() const { return TriangleMesh::prev(CornerCursor::get()); }
};

struct FaceCursor : CornerCursor {
  using value_type = FaceId;
  using CornerCursor::CornerCursor;
  FaceId get() const { return TriangleMesh::face(CornerCursor::get()); }
};

/// Walks over the neighbours of a vertex: the target of each outgoing half-edge, and in an open fan the origin of the
/// last incoming one.
class NeighbourCursor {
 public:
  using value_type = VertexId;

  NeighbourCursor() = default;
  NeighbourCursor(const TriangleMesh& mesh, std::span<const HalfedgeId> fans) : mesh_(&mesh), corner_(mesh, fans) {}

  VertexId get() const {
    const HalfedgeId h = corner_.get();
    return at_last_incoming_ ? mesh_->origin(TriangleMesh::prev(h)) : mesh_->target(h);
  }
  void advance() {
    at_last_incoming_ = !at_last_incoming_ && !corner_.next_in_fan().is_valid();
    if (!at_last_incoming_) corner_.advance();
  }
  bool operator==(const NeighbourCursor& other) const {
    return corner_ == other.corner_ && at_last_incoming_ == other.at_last_incoming_;
  }

 private:
  const TriangleMesh* mesh_ = nullptr;
  CornerCursor corner_;
  bool at_last_incoming_ = false;
};

/// Walks over the other half-edges along the three edges of a face.
class AdjacentFaceCursor {
 public:
  using value_type = FaceId;

  AdjacentFaceCursor() = default;
  AdjacentFaceCursor(const TriangleMesh& mesh, std::size_t halfedge, std::size_t end)
      : mesh_(&mesh), halfedge_(halfedge), end_(end) {
    skip();
  }

  FaceId get() const { return TriangleMesh::face(other()); }
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
        if (TriangleMesh::face(h) != TriangleMesh::face(HalfedgeId(halfedge_))) return;
    }
  }

  const TriangleMesh* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
  std::size_t end_ = 0;
  std::size_t place_ = 0;
};

/// Walks over the half-edges that are the first along their edge.
class EdgeCursor {
 public:
  using value_type = HalfedgeId;

  EdgeCursor() = default;
  EdgeCursor(const TriangleMesh& mesh, std::size_t halfedge) : mesh_(&mesh), halfedge_(halfedge) { skip(); }

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

  const TriangleMesh* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
};

/// Walks over the origins of half-edges by index.
class OriginCursor {
 public:
  using value_type = VertexId;

  OriginCursor() = default;
  OriginCursor(const TriangleMesh& mesh, std::size_t halfedge) : mesh_(&mesh), halfedge_(halfedge) {}

  VertexId get() const { return mesh_->origin(HalfedgeId(halfedge_)); }
  void advance() { ++halfedge_; }
  bool operator==(const OriginCursor& other) const { return halfedge_ == other.halfedge_; }

 private:
  const TriangleMesh* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
};

template <typename Cursor>
CursorRange<Cursor> around(const TriangleMesh& mesh, VertexId v) {
  const auto fans = mesh.fans(v);
  return {Cursor(mesh, fans), Cursor(mesh, fans.subspan(fans.size()))};
}

}  // namespace circulators

/// Half-edges that leave `v`, one per corner at `v`.
inline auto outgoing_halfedges(const TriangleMesh& mesh, VertexId v) {
  return circulators::around<circulators::CornerCursor>(mesh, v);
}
/// Half-edges that end in `v`, one per corner at `v`: the predecessors of `outgoing_halfedges`.
inline auto incoming_halfedges(const TriangleMesh& mesh, VertexId v) {
  return circulators::around<circulators::IncomingCursor>(mesh, v);
}
/// Faces with a corner at `v`; a triangle that repeats a corner appears once per corner at `v`.
inline auto faces_around(const TriangleMesh& mesh, VertexId v) {
  return circulators::around<circulators::FaceCursor>(mesh, v);
}
/// One-ring of `v`: the other end of each edge at `v`, each once; across a non-manifold edge once per side of a fan
/// that the edge bounds.
inline auto adjacent_vertices(const TriangleMesh& mesh, VertexId v) {
  return circulators::around<circulators::NeighbourCursor>(mesh, v);
}

/// The three half-edges of `f`, from corner 0.
inline HandleRange<HalfedgeId> halfedges_of(const TriangleMesh& /*mesh*/, FaceId f) {
  return {TriangleMesh::halfedge(f).index(), TriangleMesh::halfedge(f).index() + 3};
}
/// The three corners of `f`, from corner 0.
inline auto vertices_of(const TriangleMesh& mesh, FaceId f) {
  using circulators::OriginCursor;
  const std::size_t first = TriangleMesh::halfedge(f).index();
  return CursorRange<OriginCursor>(OriginCursor(mesh, first), OriginCursor(mesh, first + 3));
}
/// Faces that share an edge with `f`, without `f`: edge by edge from half-edge 0; across a non-manifold edge all other
/// faces, ascending. A face that shares two edges appears twice.
inline auto adjacent_faces(const TriangleMesh& mesh, FaceId f) {
  using circulators::AdjacentFaceCursor;
  const std::size_t first = TriangleMesh::halfedge(f).index();
  return CursorRange<AdjacentFaceCursor>(AdjacentFaceCursor(mesh, first, first + 3),
                                         AdjacentFaceCursor(mesh, first + 3, first + 3));
}

/// All elements, ascending. Random access.
inline HandleRange<VertexId> vertices(const TriangleMesh& mesh) {
  return {0, mesh.vertex_count()};
}
inline HandleRange<FaceId> faces(const TriangleMesh& mesh) {
  return {0, mesh.face_count()};
}
inline HandleRange<HalfedgeId> halfedges(const TriangleMesh& mesh) {
  return {0, mesh.halfedge_count()};
}
/// One half-edge per undirected edge, the first along it; ascending. Non-manifold edges are included.
inline auto edges(const TriangleMesh& mesh) {
  using circulators::EdgeCursor;
  return CursorRange<EdgeCursor>(EdgeCursor(mesh, 0), EdgeCursor(mesh, mesh.halfedge_count()));
}

static_assert(std::ranges::random_access_range<HandleRange<VertexId>> &&
              std::ranges::borrowed_range<HandleRange<VertexId>>);
static_assert(std::ranges::forward_range<decltype(vertices_of(TriangleMesh(), FaceId()))>);
static_assert(std::ranges::forward_range<decltype(outgoing_halfedges(TriangleMesh(), VertexId()))>);
static_assert(std::ranges::forward_range<decltype(incoming_halfedges(TriangleMesh(), VertexId()))>);
static_assert(std::ranges::forward_range<decltype(faces_around(TriangleMesh(), VertexId()))>);
static_assert(std::ranges::forward_range<decltype(adjacent_vertices(TriangleMesh(), VertexId()))>);
static_assert(std::ranges::forward_range<decltype(adjacent_faces(TriangleMesh(), FaceId()))>);
static_assert(std::ranges::forward_range<decltype(edges(TriangleMesh()))>);
static_assert(std::ranges::view<decltype(edges(TriangleMesh()))> &&
              std::ranges::borrowed_range<decltype(edges(TriangleMesh()))>);

}  // namespace algebra3d
