#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algebra3d/base/indices.h"
#include "algebra3d/base/large_allocator.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/halfedge/face_planes.h"
#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// A triangle mesh as directed edges: half-edge 3f+i leaves corner i of face f, so next, previous and face are
/// computed; the origin and the opposite of each half-edge are stored. Source: [campagna1998].
///
/// Any list of triangles can be represented. An edge is *manifold* if exactly two half-edges run along it, in opposite
/// directions; *boundary* if exactly one does; every other edge is *non-manifold*: its half-edges are in a side table
/// and have no opposite. A half-edge from a vertex to itself (a triangle that repeats a corner) is always non-manifold.
/// A vertex is *non-manifold* if its faces form more than one fan (faces linked across manifold edges); a side table
/// then has one half-edge per fan. Invariants: see `audit` (audit.h), which checks them. Memory: 24 bytes per triangle
/// and 28 per vertex where all coordinates are doubles and the mesh is manifold. Immutable after construction;
/// concurrent reading is safe. At most kMaxFaces faces.
class TriangleMesh {
 public:
  using Triangle = IndexTriangle;
  static constexpr std::size_t kMaxFaces = (std::size_t{1} << 31) / 3 - 1;

  /// The empty mesh.
  TriangleMesh() = default;
  /// Links the triangles along common edges. Every index must be below points.size() (asserted). Unused points are kept
  /// as isolated vertices. Known planes must be those of the corners. Cost: linear expected (sorting per vertex), no
  /// recursion.
  TriangleMesh(PointArray points, std::span<const Triangle> triangles, FacePlanes planes = {});

  /// In `opposites`: the half-edge is not linked yet.
  static constexpr std::uint32_t kUnlinked = 0xFFFFFFFE;
  /// The same for partly linked triangles: three origins per triangle, and per half-edge its opposite or kUnlinked. A
  /// linked edge must have no further half-edges, and a vertex must be manifold if all half-edges that leave it are
  /// linked. Cost: a few passes, and that of linking the rest.
  TriangleMesh(PointArray points, LargeVector<std::uint32_t> origins, LargeVector<std::uint32_t> opposites,
               FacePlanes planes);
  /// The same where the first vertices, those in `outgoing`, are *settled*: manifold, on no boundary, with all their
  /// edges linked and with `outgoing` as of the result. Edges between two other vertices are linked anew, whatever is
  /// in `opposites`. Cost: a scan of the origins, and that of linking the rest.
  TriangleMesh(PointArray points, LargeVector<std::uint32_t> origins, LargeVector<std::uint32_t> opposites,
               LargeVector<HalfedgeId> outgoing, FacePlanes planes);

  std::size_t vertex_count() const { return points_.size(); }
  std::size_t face_count() const { return origins_.size() / 3; }
  std::size_t halfedge_count() const { return origins_.size(); }
  bool is_empty() const { return origins_.empty(); }

  static HalfedgeId next(HalfedgeId h) { return HalfedgeId(h.index() % 3 == 2 ? h.index() - 2 : h.index() + 1); }
  static HalfedgeId prev(HalfedgeId h) { return HalfedgeId(h.index() % 3 == 0 ? h.index() + 2 : h.index() - 1); }
  static FaceId face(HalfedgeId h) { return FaceId(h.index() / 3); }
  static HalfedgeId halfedge(FaceId f, std::uint32_t corner = 0) { return HalfedgeId(3 * f.index() + corner); }

  VertexId origin(HalfedgeId h) const { return VertexId(origins_[h.index()]); }
  VertexId target(HalfedgeId h) const { return origin(next(h)); }
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
  Triangle triangle(FaceId f) const {
    const std::size_t first = halfedge(f).index();
    return {origins_[first], origins_[first + 1], origins_[first + 2]};
  }
  TriangleRef corners(FaceId f) const;

  /// Known planes of faces, possibly none. Results do not depend on them.
  const FacePlanes& planes() const { return planes_; }

  /// Bytes on the heap by the capacities of the containers, without large rationals.
  std::size_t heap_bytes() const;

 private:
  friend struct TriangleMeshBuilder;  // triangle_mesh_builder.cpp
  friend struct TriangleMeshAuditor;  // audit.cpp
  friend struct TriangleMeshTester;   // tests damage meshes through it, to see that `audit` finds it
  static constexpr std::uint32_t kNoOpposite = 0x80000000;  // set: no opposite; the low bits number a non-manifold edge
  static constexpr std::uint32_t kBoundary = 0xFFFFFFFF;

  enum class Links : std::uint8_t { none, some, all_but_between_open_vertices };
  void link(Links links);

  struct NonManifold;  // side tables (nonmanifold_tables.h); absent while everything is manifold

  PointArray points_;
  LargeVector<std::uint32_t> origins_;    // per half-edge
  LargeVector<std::uint32_t> opposites_;  // per half-edge
  LargeVector<HalfedgeId> outgoing_;      // per vertex; handles, so that `fans` can show one entry in place
  std::shared_ptr<const NonManifold> nonmanifold_;
  FacePlanes planes_;
};

}  // namespace algebra3d
