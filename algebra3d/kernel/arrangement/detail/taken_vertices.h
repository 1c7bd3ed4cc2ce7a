#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/taken_runs.h"

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
  std::size_t settled_count() const { return settled_count_; }
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

}  // namespace algebra3d::arrangement
