#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/arrangement/detail/ids.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/id_vector.h"

namespace algebra3d::arrangement {

/// Output of stage 0 and input of all others: the operands as if they were one mesh, with faces, half-edges and
/// vertices counted consecutively. Refers to the meshes, which must outlive it.
class Operands {
 public:
  /// The faces together are at most TriangleMesh::kMaxFaces. Cost: linear in the operands, and in the faces of those
  /// without a box hierarchy.
  explicit Operands(std::span<const Operand> operands);

  std::size_t count() const { return operands_.size(); }
  IdRange<OperandId> ids() const { return operands_.ids(); }
  const TriangleMesh& mesh(OperandId operand) const { return *operands_[operand].mesh; }
  std::size_t group(OperandId operand) const { return operands_[operand].group; }
  const BoxHierarchy& hierarchy(OperandId operand) const { return *hierarchies_[operand]; }

  std::size_t face_count() const { return first_faces_.back().index(); }
  std::size_t halfedge_count() const { return 3 * face_count(); }
  std::size_t vertex_count() const { return first_vertices_.back().index(); }
  IdRange<InputFaceId> faces() const { return IdRange<InputFaceId>(face_count()); }
  IdRange<InputFaceId> faces(OperandId operand) const {
    return {first_faces_[operand], first_faces_[OperandId(operand.index() + 1)]};
  }
  IdRange<InputVertexId> vertices(OperandId operand) const {
    return {first_vertices_[operand], first_vertices_[OperandId(operand.index() + 1)]};
  }
  OperandId operand_of(InputFaceId face) const {
    return operands_of_faces_.empty() ? find_operand(face) : operands_of_faces_[face];
  }
  /// The operand of a vertex. Cost: logarithmic in the operands.
  OperandId operand_of(InputVertexId vertex) const;

  /// From an id in the mesh of an operand to the id among all operands (`input`), and back (`in_mesh`).
  InputFaceId input(OperandId operand, FaceId face) const {
    return InputFaceId(first_faces_[operand].index() + face.index());
  }
  InputHalfedgeId input(OperandId operand, HalfedgeId halfedge) const {
    return InputHalfedgeId(3 * first_faces_[operand].index() + halfedge.index());
  }
  InputVertexId input(OperandId operand, VertexId vertex) const {
    return InputVertexId(first_vertices_[operand].index() + vertex.index());
  }
  FaceId in_mesh(OperandId operand, InputFaceId face) const {
    return FaceId(face.index() - first_faces_[operand].index());
  }
  HalfedgeId in_mesh(OperandId operand, InputHalfedgeId halfedge) const {
    return HalfedgeId(halfedge.index() - 3 * first_faces_[operand].index());
  }
  VertexId in_mesh(OperandId operand, InputVertexId vertex) const {
    return VertexId(vertex.index() - first_vertices_[operand].index());
  }

  static InputFaceId face(InputHalfedgeId halfedge) { return InputFaceId(halfedge.index() / 3); }
  /// The half-edge that leaves a corner (0, 1, 2) of the face.
  static InputHalfedgeId halfedge(InputFaceId face, std::size_t corner) {
    return InputHalfedgeId(3 * std::size_t{face.index()} + corner);
  }
  static IdRange<InputHalfedgeId> halfedges(InputFaceId face) { return {halfedge(face, 0), halfedge(face, 3)}; }
  /// The next half-edge of the same face, and the one before.
  static InputHalfedgeId next(InputHalfedgeId halfedge) {
    return InputHalfedgeId(halfedge.index() % 3 == 2 ? halfedge.index() - 2 : halfedge.index() + 1);
  }
  static InputHalfedgeId previous(InputHalfedgeId halfedge) {
    return InputHalfedgeId(halfedge.index() % 3 == 0 ? halfedge.index() + 2 : halfedge.index() - 1);
  }
  /// The half-edge that the edge is named after.
  static InputHalfedgeId halfedge(InputEdgeId edge) { return InputHalfedgeId(edge.index()); }

  /// The corners of a face as points, and as vertices.
  TriangleRef corners(InputFaceId face) const;
  std::array<InputVertexId, 3> vertices(InputFaceId face) const;
  /// The plane of a face, if its mesh keeps it, else null.
  const IntegerPlane* plane(InputFaceId face) const {
    const OperandId operand = operand_of(face);
    return mesh(operand).planes().find(in_mesh(operand, face).index());
  }
  /// The vertex from which a half-edge leads, and its point.
  InputVertexId origin(InputHalfedgeId halfedge) const;
  PointRef point(InputHalfedgeId origin_of) const;
  /// The other half-edge of a manifold edge, else none.
  InputHalfedgeId opposite(InputHalfedgeId halfedge) const;
  /// The edge along which a half-edge runs: the lowest half-edge along it gives the name.
  InputEdgeId edge(InputHalfedgeId halfedge) const;
  /// All half-edges along an edge, ascending.
  void halfedges_along(InputEdgeId edge, std::vector<InputHalfedgeId>& result) const;
  /// All half-edges that leave the origin of the half-edge.
  void halfedges_around_origin(InputHalfedgeId halfedge, std::vector<InputHalfedgeId>& result) const;

 private:
  OperandId find_operand(InputFaceId face) const;

  IdSpan<OperandId, const Operand> operands_;
  // The first ones of each operand, and those after the last operand.
  IdVector<OperandId, InputFaceId> first_faces_;
  IdVector<OperandId, InputVertexId> first_vertices_;
  IdVector<InputFaceId, OperandId> operands_of_faces_;  // empty if the operands are so few that they are soon searched
  IdVector<OperandId, const BoxHierarchy*> hierarchies_;
  std::vector<std::unique_ptr<const BoxHierarchy>> own_hierarchies_;
};

/// The box hierarchy of all faces of a mesh. Cost: linear.
std::unique_ptr<const BoxHierarchy> hierarchy_of(const TriangleMesh& mesh);

/// The error limit_exceeded if the operands have more faces than one arrangement can number. `what` names the operands
/// in the message.
Status check_face_count(const char* what, std::span<const Operand> operands);

/// Every violated invariant, one sentence each: an operand has a group below WindingVector::kGroupCount and a hierarchy
/// of all its faces; the faces of operands follow each other without gaps.
std::vector<std::string> audit(const Operands& operands);

}  // namespace algebra3d::arrangement
