#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algebra3d/exact/point.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/halfedge/face_planes.h"
#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// Triangle mesh as directed edges: half-edge 3f+i leaves corner i of face f, so that next, previous and face are
/// arithmetic; the origin and the opposite of each half-edge are stored. Source: [campagna1998].
///
/// Any list of triangles is representable, nothing is dropped. An edge is *manifold* if exactly two half-edges run
/// along it, in opposite directions; *boundary* if exactly one does; every other edge is *non-manifold*, its half-edges
/// stand in a side table and have no opposite. A half-edge from a vertex to itself (a triangle that repeats a corner)
/// is non-manifold, be it alone or not. A vertex is *non-manifold* if its faces form more than one fan (faces linked
/// across manifold edges); a side table then holds one half-edge per fan. Invariants: `audit` (audit.h) lists them and
/// finds every violation. Memory: 24 bytes per triangle and 28 per vertex where all coordinates are doubles and the
/// mesh is manifold. Immutable after construction; concurrent reading is safe. At most kMaxFaces faces.
class TriangleMesh {
 public:
  using Triangle = std::array<std::uint32_t, 3>;
  static constexpr std::size_t kMaxFaces = (std::size_t{1} << 31) / 3 - 1;

  /// The empty mesh.
  TriangleMesh() = default;
  /// Links the triangles along common edges. Every index is below points.size() (asserted). Points that no triangle
  /// uses are kept as isolated vertices. Cost: linear expected (sorting per vertex), no recursion.
  /// Planes that are known must be those of the corners.
  TriangleMesh(PointArray points, std::span<const Triangle> triangles, FacePlanes planes = {});

  /// In `opposites`: the half-edge's edge is still to be looked for.
  static constexpr std::uint32_t kUnlinked = 0xFFFFFFFE;
  /// The same for triangles that are linked in part: three origins to a triangle, and for each half-edge its opposite
  /// or kUnlinked. Nothing else may run along an edge that is linked, and a vertex is manifold if all half-edges that
  /// leave it are. Cost: a few passes, and what there is to link.
  TriangleMesh(PointArray points, std::vector<std::uint32_t> origins, std::vector<std::uint32_t> opposites,
               FacePlanes planes);

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

  /// Some half-edge that leaves `v`; at a boundary vertex the one from which a counter-clockwise walk sees the whole
  /// fan. Invalid at an isolated vertex.
  HalfedgeId outgoing(VertexId v) const { return outgoing_[v.index()]; }
  bool is_isolated(VertexId v) const { return !outgoing(v).is_valid(); }
  bool is_nonmanifold(VertexId v) const;
  /// One half-edge per fan of `v`, each the first of its fan; one entry at a manifold vertex, none at an isolated one.
  std::span<const HalfedgeId> fans(VertexId v) const;
  /// Ascending.
  std::vector<VertexId> nonmanifold_vertices() const;

  PointRef point(VertexId v) const { return points_[v.index()]; }
  const PointArray& points() const { return points_; }
  Triangle triangle(FaceId f) const;
  TriangleRef corners(FaceId f) const;

  /// Known planes of faces; none has to be. Volumes and surfaces are the same whether they are known or not.
  const FacePlanes& planes() const { return planes_; }

  /// Bytes on the heap, as counted from the containers' capacities, without those of large rationals.
  std::size_t heap_bytes() const;

 private:
  friend struct TriangleMeshBuilder;  // triangle_mesh_builder.cpp
  friend struct TriangleMeshAuditor;  // audit.cpp
  friend struct TriangleMeshTester;   // tests damage meshes through it, to see that `audit` finds it
  static constexpr std::uint32_t kNoOpposite = 0x80000000;  // set: no opposite; the low bits number a non-manifold edge
  static constexpr std::uint32_t kBoundary = 0xFFFFFFFF;

  void link(bool has_links);

  struct NonManifold;  // side tables (nonmanifold_tables.h); absent while everything is manifold

  PointArray points_;
  std::vector<std::uint32_t> origins_;    // per half-edge
  std::vector<std::uint32_t> opposites_;  // per half-edge
  std::vector<HalfedgeId> outgoing_;      // per vertex; handles, so that `fans` can show one entry in place
  std::shared_ptr<const NonManifold> nonmanifold_;
  FacePlanes planes_;
};

}  // namespace algebra3d
