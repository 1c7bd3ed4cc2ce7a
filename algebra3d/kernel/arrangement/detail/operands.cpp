#include "algebra3d/kernel/arrangement/detail/operands.h"

#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d::arrangement {

std::unique_ptr<const BoxHierarchy> hierarchy_of(const TriangleMesh& mesh) {
  return std::make_unique<const BoxHierarchy>(mesh);
}

Operands::Operands(std::span<const Operand> operands) : operands_(operands) {
  InputFaceId face(0);
  InputVertexId vertex(0);
  for (const Operand& operand : operands) {
    first_faces_.push_back(face);
    first_vertices_.push_back(vertex);
    face = InputFaceId(face.index() + operand.mesh->face_count());
    vertex = InputVertexId(vertex.index() + operand.mesh->vertex_count());
    if (operand.hierarchy == nullptr) own_hierarchies_.push_back(hierarchy_of(*operand.mesh));
    hierarchies_.push_back(operand.hierarchy != nullptr ? operand.hierarchy : own_hierarchies_.back().get());
  }
  first_faces_.push_back(face);
  first_vertices_.push_back(vertex);
  constexpr std::size_t kFew = 4;
  if (count() <= kFew) return;
  operands_of_faces_.reserve(face_count());
  for (const OperandId operand : ids())
    operands_of_faces_.resize(operands_of_faces_.size() + mesh(operand).face_count(), operand);
}

OperandId Operands::find_operand(InputFaceId face) const {
  std::size_t after = 1;
  while (first_faces_[OperandId(after)] <= face) ++after;
  return OperandId(after - 1);
}

OperandId Operands::operand_of(InputVertexId vertex) const {
  const auto after = std::upper_bound(first_vertices_.begin(), first_vertices_.end(), vertex);
  return OperandId(after - first_vertices_.begin() - 1);
}

TriangleRef Operands::corners(InputFaceId face) const {
  const OperandId operand = operand_of(face);
  return mesh(operand).corners(in_mesh(operand, face));
}

std::array<InputVertexId, 3> Operands::vertices(InputFaceId face) const {
  const OperandId operand = operand_of(face);
  const auto& [a, b, c] = mesh(operand).triangle(in_mesh(operand, face));
  return {input(operand, VertexId(a)), input(operand, VertexId(b)), input(operand, VertexId(c))};
}

InputVertexId Operands::origin(InputHalfedgeId halfedge) const {
  const OperandId operand = operand_of(face(halfedge));
  return input(operand, mesh(operand).origin(in_mesh(operand, halfedge)));
}

PointRef Operands::point(InputHalfedgeId origin_of) const {
  const OperandId operand = operand_of(face(origin_of));
  return mesh(operand).point(mesh(operand).origin(in_mesh(operand, origin_of)));
}

InputHalfedgeId Operands::opposite(InputHalfedgeId halfedge) const {
  const OperandId operand = operand_of(face(halfedge));
  const HalfedgeId other = mesh(operand).opposite(in_mesh(operand, halfedge));
  return other.is_valid() ? input(operand, other) : InputHalfedgeId::none();
}

InputEdgeId Operands::edge(InputHalfedgeId halfedge) const {
  const OperandId operand = operand_of(face(halfedge));
  const HalfedgeId local = in_mesh(operand, halfedge);
  HalfedgeId lowest = local;
  if (const HalfedgeId other = mesh(operand).opposite(local); other.is_valid())
    lowest = std::min(local, other);
  else if (mesh(operand).is_nonmanifold(local))
    lowest = mesh(operand).edge_halfedges(local).front();
  return InputEdgeId(input(operand, lowest).index());
}

void Operands::halfedges_along(InputEdgeId edge, std::vector<InputHalfedgeId>& result) const {
  result.clear();
  const OperandId operand = operand_of(face(halfedge(edge)));
  const HalfedgeId local = in_mesh(operand, halfedge(edge));
  if (mesh(operand).is_nonmanifold(local)) {
    for (const HalfedgeId h : mesh(operand).edge_halfedges(local)) result.push_back(input(operand, h));
    return;
  }
  result.push_back(halfedge(edge));
  if (const HalfedgeId other = mesh(operand).opposite(local); other.is_valid()) result.push_back(input(operand, other));
}

void Operands::halfedges_around_origin(InputHalfedgeId halfedge, std::vector<InputHalfedgeId>& result) const {
  result.clear();
  const OperandId operand = operand_of(face(halfedge));
  for (const HalfedgeId h : outgoing_halfedges(mesh(operand), mesh(operand).origin(in_mesh(operand, halfedge))))
    result.push_back(input(operand, h));
}

Status check_face_count(const char* what, std::span<const Operand> operands) {
  std::size_t face_count = 0;
  for (const Operand& operand : operands) face_count += operand.mesh->face_count();
  if (face_count <= TriangleMesh::kMaxFaces) return {};
  return Error{ErrorCode::limit_exceeded, "the {} have {} triangles together; expected at most {}", what, face_count,
               TriangleMesh::kMaxFaces};
}

}  // namespace algebra3d::arrangement
