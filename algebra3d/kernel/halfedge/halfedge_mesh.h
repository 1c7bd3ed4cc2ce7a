#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/face_layout.h"
#include "algebra3d/kernel/halfedge/handle.h"
#include "base/indices.h"
#include "base/large_allocator.h"

namespace algebra3d {

struct NonManifoldTables;  // detail/nonmanifold_tables.h
template <typename Layout>
struct MeshLinker;  // detail/mesh_linker.h
template <typename Layout>
class ManifoldLinker;  // detail/manifold_linker.h
template <typename Layout>
struct MeshAuditor;  // audit.cpp

/// The common base of meshes of triangles and of polygons: vertices, and half-edges with origins and opposites. The
/// half-edges of a face are numbered consecutively, so next, previous and face are computed by `Layout`. Source:
/// [campagna1998], for triangles.
///
/// Any list of faces can be represented. An edge is *manifold* if exactly two half-edges run along it, in opposite
/// directions; *boundary* if exactly one does; every other edge is *non-manifold*: its half-edges are in a side table
/// and have no opposite. A half-edge from a vertex to itself (a face that repeats a corner) is always non-manifold. A
/// vertex is *non-manifold* if its faces form more than one fan (faces linked across manifold edges); a side table then
/// has one half-edge per fan. Invariants: see `audit` (audit.h), which checks them. Immutable after construction;
/// concurrent reading is safe.
template <typename Layout>
class HalfedgeMesh : public Layout {
 public:
  static constexpr std::size_t kMaxHalfedges = (std::size_t{1} << 31) - 3;

  std::size_t vertex_count() const { return points_.size(); }
  std::size_t face_count() const { return Layout::count_faces(origins_.size()); }
  std::size_t halfedge_count() const { return origins_.size(); }
  bool is_empty() const { return origins_.empty(); }

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
  std::span<const HalfedgeId> edge_halfedges(HalfedgeId h) const;
  std::size_t nonmanifold_edge_count() const;
  /// Half-edges of the n-th non-manifold edge, in order of first half-edge.
  std::span<const HalfedgeId> nonmanifold_edge(std::size_t n) const;

  /// A half-edge that leaves `v`; at a boundary vertex the first of its fan counter-clockwise. Invalid at an isolated
  /// vertex.
  HalfedgeId outgoing(VertexId v) const { return outgoing_[v.index()]; }
  bool is_isolated(VertexId v) const { return !outgoing(v).is_valid(); }
  bool is_nonmanifold(VertexId v) const;
  /// One half-edge per fan of `v`, each the first of its fan; one entry at a manifold vertex, none at an isolated one.
  std::span<const HalfedgeId> fans(VertexId v) const;
  /// The non-manifold vertices, ascending.
  std::vector<VertexId> nonmanifold_vertices() const;

  PointRef point(VertexId v) const { return points_[v.index()]; }
  const PointArray& points() const { return points_; }
  /// The origins of all half-edges: the corners of the faces, one face after the other.
  const LargeVector<std::uint32_t>& origins() const { return origins_; }

  /// Bytes on the heap by the capacities of the containers, without large rationals.
  std::size_t heap_bytes() const;

 protected:
  /// In `opposites`: the half-edge is not linked yet.
  static constexpr std::uint32_t kUnlinkedHalfedge = 0xFFFFFFFE;
  /// The links that are given: none; opposites that are right if the mesh is manifold; half-edges whose opposites are
  /// given; or all edges with a settled end: the first vertices, those in `outgoing`, are settled; or everything:
  /// opposites, outgoing half-edges, and that the mesh is manifold.
  enum class Links : std::uint8_t { none, proposed, some, all_but_between_open_vertices, all };

  HalfedgeMesh() = default;
  /// Links all faces. Cost: linear expected (sorting per vertex), no recursion.
  HalfedgeMesh(PointArray points, Layout layout, LargeVector<std::uint32_t> origins)
      : HalfedgeMesh(std::move(points), std::move(layout), std::move(origins), {}, {}, Links::none) {}
  /// Links what is not linked yet. Cost: a few passes, and that of linking the rest.
  HalfedgeMesh(PointArray points, Layout layout, LargeVector<std::uint32_t> origins,
               LargeVector<std::uint32_t> opposites, LargeVector<HalfedgeId> outgoing, Links links);
  /// The faces and links of another mesh over other points, one per vertex.
  HalfedgeMesh(const HalfedgeMesh& linked, PointArray points);
  HalfedgeMesh(const HalfedgeMesh&) = default;
  HalfedgeMesh(HalfedgeMesh&&) noexcept = default;
  HalfedgeMesh& operator=(const HalfedgeMesh&) = default;
  HalfedgeMesh& operator=(HalfedgeMesh&&) noexcept = default;
  ~HalfedgeMesh() = default;

 private:
  friend struct MeshLinker<Layout>;
  friend class ManifoldLinker<Layout>;
  friend struct MeshAuditor<Layout>;
  friend struct MeshTester;  // tests damage meshes through it, to see that `audit` finds it
  static constexpr std::uint32_t kNoOpposite = 0x80000000;  // set: no opposite; the low bits number a non-manifold edge
  static constexpr std::uint32_t kBoundary = kNone;

  PointArray points_;
  LargeVector<std::uint32_t> origins_;                    // per half-edge
  LargeVector<std::uint32_t> opposites_;                  // per half-edge
  LargeVector<HalfedgeId> outgoing_;                      // per vertex; handles, so that `fans` can show one in place
  std::shared_ptr<const NonManifoldTables> nonmanifold_;  // absent while everything is manifold
};

extern template class HalfedgeMesh<TriangleLayout>;
extern template class HalfedgeMesh<PolygonLayout>;

}  // namespace algebra3d
