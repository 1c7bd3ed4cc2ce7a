#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/face_layout.h"
#include "algebra3d/halfedge/handle.h"
#include "algebra3d/halfedge/nonmanifold_tables.h"

namespace algebra3d {

/// Navigation in meshes of triangles and of polygons: vertices, and half-edges with origins and opposites. The
/// half-edges of a face are numbered consecutively, so next, previous and face are computed by `Layout`. Source:
/// [campagna1998], for triangles. `Arrays` names the types of the arrays, which own their content or refer to it.
///
/// Any list of faces can be represented. An edge is *manifold* if exactly two half-edges run along it, in opposite
/// directions; *boundary* if exactly one does; every other edge is *non-manifold*: its half-edges are in a side table
/// and have no opposite. A half-edge from a vertex to itself (a face that repeats a corner) is always non-manifold. A
/// vertex is *non-manifold* if its faces form more than one fan (faces linked across manifold edges); a side table then
/// has one half-edge per fan. Immutable after construction; concurrent reading is safe.
///
/// Handles that are passed must be those of elements of the mesh. Cost: constant, where nothing else is said.
template <typename Layout, typename Arrays>
class HalfedgeStructure : public Layout {
 public:
  static constexpr std::size_t kMaxHalfedges = (std::size_t{1} << 31) - 3;

  std::size_t vertex_count() const { return points_.size(); }
  std::size_t face_count() const { return Layout::count_faces(origins_.size()); }
  std::size_t halfedge_count() const { return origins_.size(); }
  bool is_empty() const { return origins_.empty(); }
  /// True if no edge and no vertex is non-manifold.
  bool is_manifold() const { return !nonmanifold_; }

  VertexId origin(HalfedgeId h) const { return VertexId(origins_[h.index()]); }
  VertexId target(HalfedgeId h) const { return origin(this->next(h)); }
  /// The other half-edge of a manifold edge; invalid at boundary and non-manifold edges.
  HalfedgeId opposite(HalfedgeId h) const {
    const std::uint32_t stored = opposites_[h.index()];
    return (stored & kNoOpposite) != 0 ? HalfedgeId() : HalfedgeId(stored);
  }
  bool is_boundary(HalfedgeId h) const { return opposites_[h.index()] == kBoundary; }
  bool is_nonmanifold(HalfedgeId h) const {
    return (opposites_[h.index()] & kNoOpposite) != 0 && opposites_[h.index()] != kBoundary;
  }
  /// All half-edges along the edge of a non-manifold `h` (itself included), ascending.
  std::span<const HalfedgeId> edge_halfedges(HalfedgeId h) const {
    assert(is_nonmanifold(h));
    return nonmanifold_edge(opposites_[h.index()] & ~kNoOpposite);
  }
  std::size_t nonmanifold_edge_count() const { return nonmanifold_ ? nonmanifold_->edge_starts.size() - 1 : 0; }
  /// Half-edges of the n-th non-manifold edge, in order of first half-edge.
  std::span<const HalfedgeId> nonmanifold_edge(std::size_t n) const {
    return list(nonmanifold_->edge_starts, nonmanifold_->edge_halfedges, n);
  }

  /// A half-edge that leaves `v`; at a boundary vertex the first of its fan counter-clockwise. Invalid at an isolated
  /// vertex.
  HalfedgeId outgoing(VertexId v) const { return outgoing_[v.index()]; }
  bool is_isolated(VertexId v) const { return !outgoing(v).is_valid(); }
  /// Cost: a binary search among the non-manifold vertices.
  bool is_nonmanifold(VertexId v) const {
    return nonmanifold_ && std::ranges::binary_search(nonmanifold_->vertices, v.index());
  }
  /// One half-edge per fan of `v`, each the first of its fan; one entry at a manifold vertex, none at an isolated one.
  /// Cost: as is_nonmanifold.
  std::span<const HalfedgeId> fans(VertexId v) const {
    if (nonmanifold_) {
      const auto& vertices = nonmanifold_->vertices;
      const auto found = std::ranges::lower_bound(vertices, v.index());
      if (found != vertices.end() && *found == v.index())
        return list(nonmanifold_->fan_starts, nonmanifold_->fans, static_cast<std::size_t>(found - vertices.begin()));
    }
    return {&outgoing_[v.index()], is_isolated(v) ? std::size_t{0} : std::size_t{1}};
  }
  /// The non-manifold vertices, ascending. Cost: linear in their number.
  std::vector<VertexId> nonmanifold_vertices() const {
    if (!nonmanifold_) return {};
    std::vector<VertexId> result;
    result.reserve(nonmanifold_->vertices.size());
    for (const std::uint32_t v : nonmanifold_->vertices) result.emplace_back(v);
    return result;
  }

  const typename Arrays::Points& points() const { return points_; }
  /// The origins of all half-edges: the corners of the faces, one face after the other.
  const typename Arrays::Numbers& origins() const { return origins_; }

 protected:
  static constexpr std::uint32_t kNoOpposite = 0x80000000;  // set: no opposite; the low bits number a non-manifold edge
  static constexpr std::uint32_t kBoundary = 0xFFFFFFFF;

  HalfedgeStructure() = default;
  HalfedgeStructure(Layout layout, typename Arrays::Points points, typename Arrays::Numbers origins,
                    typename Arrays::Numbers opposites, typename Arrays::Handles outgoing,
                    typename Arrays::Tables nonmanifold)
      : Layout(std::move(layout)),
        points_(std::move(points)),
        origins_(std::move(origins)),
        opposites_(std::move(opposites)),
        outgoing_(std::move(outgoing)),
        nonmanifold_(std::move(nonmanifold)) {}

  typename Arrays::Points points_;
  typename Arrays::Numbers origins_;               // per half-edge
  typename Arrays::Numbers opposites_;             // per half-edge
  typename Arrays::Handles outgoing_;              // per vertex; handles, so that `fans` can show one in place
  typename Arrays::Tables nonmanifold_ = nullptr;  // a pointer; null while everything is manifold

 private:
  static std::span<const HalfedgeId> list(const std::vector<std::uint32_t>& starts,
                                          const std::vector<HalfedgeId>& values, std::size_t n) {
    return std::span(values).subspan(starts[n], starts[n + 1] - starts[n]);
  }
};

}  // namespace algebra3d
