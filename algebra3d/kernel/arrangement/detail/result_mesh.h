#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/patch_corners.h"
#include "algebra3d/kernel/arrangement/detail/regions.h"
#include "algebra3d/kernel/arrangement/detail/taken_runs.h"
#include "algebra3d/kernel/halfedge/face_planes.h"

namespace algebra3d::arrangement {

/// The corners of the faces that a result takes over, as vertices of the result. First come the *settled* ones, in the
/// order of the operands: all faces round them are taken over, as one fan without a boundary, so nothing has to be
/// linked there. Then come those at nodes, in the order of the nodes; then others that are not manifold, or on a
/// boundary of their operand.
class TakenVertices {
 public:
  /// Cost: linear in the vertices, in parallel.
  TakenVertices(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept);

  /// The vertex of the result. Demands a corner of a face that is taken over.
  VertexId operator[](InputVertexId vertex) const { return numbers_[vertex]; }
  /// The vertices at nodes; invalid at nodes that are not corners.
  const IdVector<NodeId, VertexId>& at_nodes() const { return at_nodes_; }
  /// The points of all of them, with room for those of the other nodes.
  PointArray points() const;
  /// For each settled vertex its TriangleMesh::outgoing.
  LargeVector<HalfedgeId> outgoing(const TakenRuns& runs) const;

 private:
  /// Marks a vertex that is not settled and gets its number later.
  static constexpr VertexId kOpen{0xFFFFFFFE};

  void number_settled(const KeptPatches& kept);
  void number_nodes(const PatchCorners& patch_corners);
  void number_others(const KeptPatches& kept);
  bool is_kept(OperandId operand, HalfedgeId halfedge, const KeptPatches& kept) const;

  const Subdivision& subdivision_;
  const Operands& operands_;
  IdVector<InputVertexId, VertexId> numbers_;
  std::size_t settled_count_ = 0;
  IdVector<NodeId, VertexId> at_nodes_;
  std::size_t node_count_ = 0;
  std::vector<InputVertexId> others_;  // neither settled nor at nodes
};

/// Collects the planes that a result keeps: those that faces of operands bring along, and those of regions with corners
/// that are not doubles.
class ResultPlanes {
 public:
  explicit ResultPlanes(const Subdivision& subdivision)
      : subdivision_(subdivision), numbers_(subdivision.operands.count()) {}

  /// Adds the planes that the operand keeps of the faces of the run.
  void take(const TakenRun& run);
  /// The faces of the result in the range lie in the plane.
  void add(IdRange<FaceId> faces, PlaneId plane, bool is_flipped);
  FacePlanes take_planes() { return std::move(planes_); }

 private:
  /// The numbers that the planes of an operand have in the result, kNone for those not yet taken; empty before the
  /// first one is.
  using NewNumbers = std::vector<std::uint32_t>;

  const Subdivision& subdivision_;
  FacePlanes planes_;
  IdVector<OperandId, std::array<NewNumbers, 2>> numbers_;  // of planes as they are, and flipped
};

/// A mesh that is complete but for links between edges at vertices that are not settled (TakenVertices), and refers to
/// nothing: its sources can be freed before these are found.
struct UnlinkedMesh {
  PointArray points;
  LargeVector<std::uint32_t> origins, opposites;  ///< as TriangleMesh takes them
  LargeVector<HalfedgeId> outgoing;               ///< of the settled vertices
  FacePlanes planes;
  std::shared_ptr<const FaceOrder> order;  ///< as TriangleMesh::face_order
};

/// The mesh, with all edges linked. Cost: linear in the half-edges, and little for those that are linked.
TriangleMesh linked(UnlinkedMesh mesh);

/// The mesh of a result as it grows: first the faces of patches, which bring their adjacency along, then triangles of
/// regions. Call `add` for each region, then `finish`.
class ResultMesh {
 public:
  /// Takes the faces of patches with their corners, adjacency and planes, in parallel. Edges between two vertices that
  /// are not settled are not linked. Leaves room for `region_triangles`.
  ResultMesh(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept,
             std::size_t region_triangles);

  /// Adds the triangles of a region, with nodes for corners. If some corner is not a double, the plane is kept.
  void add(const Region& region, std::span<const IndexTriangle> triangles);
  /// The mesh. Leaves this object empty.
  UnlinkedMesh finish();

 private:
  void take_patches();
  void take_faces(FaceId first, FaceId last);
  void take_corners(const TakenRun& run, FaceId first, std::size_t count);
  void take_opposites(const TakenRun& run, FaceId first, std::size_t count);
  VertexId vertex_at(NodeId node);

  const Subdivision& subdivision_;
  TakenRuns runs_;
  TakenVertices vertices_;
  IdVector<NodeId, VertexId> at_nodes_;  // invalid: not there so far
  UnlinkedMesh mesh_;                    // without planes
  ResultPlanes planes_;
};

}  // namespace algebra3d::arrangement
