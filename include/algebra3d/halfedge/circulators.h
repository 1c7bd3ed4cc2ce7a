#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "algebra3d/halfedge/cursor_range.h"
#include "algebra3d/halfedge/halfedge_structure.h"

/// Neighbourhoods and elements of a mesh as lazy ranges: forward (all elements of a kind: random access), without
/// allocation, for use with std::views. Iterators may outlive their range but not the mesh. Handles that are passed
/// must be valid in the mesh.
///
/// Around a vertex the order is counter-clockwise, fan by fan in the order of `HalfedgeStructure::fans`; each fan
/// starts at its first half-edge. All fans of a non-manifold vertex are included; an isolated vertex has empty
/// neighbourhoods.
namespace algebra3d {
namespace circulators {

/// Walks over the half-edges that leave a vertex.
template <typename Mesh>
class CornerCursor {
 public:
  using value_type = HalfedgeId;

  CornerCursor() = default;
  /// The first half-edge of `fans`.
  CornerCursor(const Mesh& mesh, std::span<const HalfedgeId> fans)
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
  const Mesh& mesh() const { return *mesh_; }

 private:
  void enter_fan() { current_ = fan_ == fans_end_ ? HalfedgeId() : *fan_; }

  const Mesh* mesh_ = nullptr;
  const HalfedgeId* fan_ = nullptr;
  const HalfedgeId* fans_end_ = nullptr;
  HalfedgeId current_;
};

/// The half-edges that end in a vertex: in each corner the one before that which leaves it.
template <typename Mesh>
struct IncomingCursor : CornerCursor<Mesh> {
  using CornerCursor<Mesh>::CornerCursor;
  HalfedgeId get() const { return this->mesh().prev(CornerCursor<Mesh>::get()); }
};

template <typename Mesh>
struct FaceCursor : CornerCursor<Mesh> {
  using value_type = FaceId;
  using CornerCursor<Mesh>::CornerCursor;
  FaceId get() const { return this->mesh().face(CornerCursor<Mesh>::get()); }
};

/// Walks over the neighbours of a vertex: the target of each outgoing half-edge, and in an open fan the origin of the
/// last incoming one.
template <typename Mesh>
class NeighbourCursor {
 public:
  using value_type = VertexId;

  NeighbourCursor() = default;
  NeighbourCursor(const Mesh& mesh, std::span<const HalfedgeId> fans) : mesh_(&mesh), corner_(mesh, fans) {}

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
  const Mesh* mesh_ = nullptr;
  CornerCursor<Mesh> corner_;
  bool at_last_incoming_ = false;
};

/// Walks over the faces along the edges of a face: those of the other half-edges.
template <typename Mesh>
class AdjacentFaceCursor {
 public:
  using value_type = FaceId;

  AdjacentFaceCursor() = default;
  AdjacentFaceCursor(const Mesh& mesh, std::size_t halfedge, std::size_t end)
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

  const Mesh* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
  std::size_t end_ = 0;
  std::size_t place_ = 0;
};

/// Walks over the origins of half-edges by index.
template <typename Mesh>
class OriginCursor {
 public:
  using value_type = VertexId;

  OriginCursor() = default;
  OriginCursor(const Mesh& mesh, std::size_t halfedge) : mesh_(&mesh), halfedge_(halfedge) {}

  VertexId get() const { return mesh_->origin(HalfedgeId(halfedge_)); }
  void advance() { ++halfedge_; }
  bool operator==(const OriginCursor& other) const { return halfedge_ == other.halfedge_; }

 private:
  const Mesh* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
};

template <typename Cursor, typename Layout, typename Arrays>
CursorRange<Cursor> around(const HalfedgeStructure<Layout, Arrays>& mesh, VertexId v) {
  const auto fans = mesh.fans(v);
  return {Cursor(mesh, fans), Cursor(mesh, fans.subspan(fans.size()))};
}

/// The numbers of the half-edges of a face: the first, and the end.
template <typename Layout, typename Arrays>
std::pair<std::size_t, std::size_t> halfedge_bounds(const HalfedgeStructure<Layout, Arrays>& mesh, FaceId f) {
  const std::size_t first = mesh.halfedge(f).index();
  return {first, first + mesh.degree(f)};
}

}  // namespace circulators

/// Half-edges that leave `v`, one per corner at `v`.
template <typename Layout, typename Arrays>
auto outgoing_halfedges(const HalfedgeStructure<Layout, Arrays>& mesh, VertexId v) {
  return circulators::around<circulators::CornerCursor<HalfedgeStructure<Layout, Arrays>>>(mesh, v);
}
/// Half-edges that end in `v`, one per corner at `v`, in the order of the corners.
template <typename Layout, typename Arrays>
auto incoming_halfedges(const HalfedgeStructure<Layout, Arrays>& mesh, VertexId v) {
  return circulators::around<circulators::IncomingCursor<HalfedgeStructure<Layout, Arrays>>>(mesh, v);
}
/// Faces with a corner at `v`; a face that repeats a corner appears once per corner at `v`.
template <typename Layout, typename Arrays>
auto faces_around(const HalfedgeStructure<Layout, Arrays>& mesh, VertexId v) {
  return circulators::around<circulators::FaceCursor<HalfedgeStructure<Layout, Arrays>>>(mesh, v);
}
/// One-ring of `v`: the other end of each edge at `v`, each once; across a non-manifold edge once per side of a fan
/// that the edge bounds.
template <typename Layout, typename Arrays>
auto adjacent_vertices(const HalfedgeStructure<Layout, Arrays>& mesh, VertexId v) {
  return circulators::around<circulators::NeighbourCursor<HalfedgeStructure<Layout, Arrays>>>(mesh, v);
}

/// The half-edges of `f`, from corner 0.
template <typename Layout, typename Arrays>
HandleRange<HalfedgeId> halfedges_of(const HalfedgeStructure<Layout, Arrays>& mesh, FaceId f) {
  const auto [first, end] = circulators::halfedge_bounds(mesh, f);
  return {first, end};
}
/// The corners of `f`, from corner 0.
template <typename Layout, typename Arrays>
auto vertices_of(const HalfedgeStructure<Layout, Arrays>& mesh, FaceId f) {
  using Cursor = circulators::OriginCursor<HalfedgeStructure<Layout, Arrays>>;
  const auto [first, end] = circulators::halfedge_bounds(mesh, f);
  return CursorRange<Cursor>(Cursor(mesh, first), Cursor(mesh, end));
}
/// Faces that share an edge with `f`, without `f`: edge by edge from half-edge 0; across a non-manifold edge all other
/// faces, ascending. A face that shares two edges appears twice.
template <typename Layout, typename Arrays>
auto adjacent_faces(const HalfedgeStructure<Layout, Arrays>& mesh, FaceId f) {
  using Cursor = circulators::AdjacentFaceCursor<HalfedgeStructure<Layout, Arrays>>;
  const auto [first, end] = circulators::halfedge_bounds(mesh, f);
  return CursorRange<Cursor>(Cursor(mesh, first, end), Cursor(mesh, end, end));
}

// These ranges refer to the mesh: not of a mesh that is gone when they are used.
template <typename Layout, typename Arrays>
void outgoing_halfedges(const HalfedgeStructure<Layout, Arrays>&&, VertexId) = delete;
template <typename Layout, typename Arrays>
void incoming_halfedges(const HalfedgeStructure<Layout, Arrays>&&, VertexId) = delete;
template <typename Layout, typename Arrays>
void faces_around(const HalfedgeStructure<Layout, Arrays>&&, VertexId) = delete;
template <typename Layout, typename Arrays>
void adjacent_vertices(const HalfedgeStructure<Layout, Arrays>&&, VertexId) = delete;
template <typename Layout, typename Arrays>
void vertices_of(const HalfedgeStructure<Layout, Arrays>&&, FaceId) = delete;
template <typename Layout, typename Arrays>
void adjacent_faces(const HalfedgeStructure<Layout, Arrays>&&, FaceId) = delete;

/// All elements, ascending. Random access.
template <typename Layout, typename Arrays>
HandleRange<VertexId> vertices(const HalfedgeStructure<Layout, Arrays>& mesh) {
  return {0, mesh.vertex_count()};
}
template <typename Layout, typename Arrays>
HandleRange<FaceId> faces(const HalfedgeStructure<Layout, Arrays>& mesh) {
  return {0, mesh.face_count()};
}
template <typename Layout, typename Arrays>
HandleRange<HalfedgeId> halfedges(const HalfedgeStructure<Layout, Arrays>& mesh) {
  return {0, mesh.halfedge_count()};
}

}  // namespace algebra3d
