#include "algebra3d/arrangement/operands.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "algebra3d/halfedge/circulators.h"

namespace algebra3d::arrangement {

Operands::Operands(std::span<const Operand> operands) : operands_(operands) {
  first_face_.push_back(0);
  first_vertex_.push_back(0);
  for (const Operand& operand : operands) {
    first_face_.push_back(first_face_.back() + static_cast<std::uint32_t>(operand.mesh->face_count()));
    first_vertex_.push_back(first_vertex_.back() + static_cast<std::uint32_t>(operand.mesh->vertex_count()));
    if (operand.hierarchy == nullptr) {
      std::vector<std::uint32_t> faces(operand.mesh->face_count());
      std::iota(faces.begin(), faces.end(), 0U);
      own_hierarchies_.push_back(std::make_unique<const BoxHierarchy>(*operand.mesh, std::move(faces)));
    }
    hierarchies_.push_back(operand.hierarchy != nullptr ? operand.hierarchy : own_hierarchies_.back().get());
  }
  constexpr std::size_t kFew = 4;
  if (count() > kFew)
    for (std::uint32_t operand = 0; operand < count(); ++operand)
      operands_of_faces_.resize(first_face_[operand + 1], operand);
}

std::uint32_t Operands::find_operand(std::uint32_t face) const {
  std::uint32_t operand = 0;
  while (first_face_[operand + 1] <= face) ++operand;
  return operand;
}

std::uint32_t Operands::operand_of_vertex(std::uint32_t vertex) const {
  const auto after = std::upper_bound(first_vertex_.begin(), first_vertex_.end(), vertex);
  return static_cast<std::uint32_t>(after - first_vertex_.begin() - 1);
}

TriangleRef Operands::corners(std::uint32_t face) const {
  const std::uint32_t operand = operand_of_face(face);
  return mesh(operand).corners(FaceId(face - first_face_[operand]));
}

TriangleMesh::Triangle Operands::vertices(std::uint32_t face) const {
  const std::uint32_t operand = operand_of_face(face);
  TriangleMesh::Triangle result = mesh(operand).triangle(FaceId(face - first_face_[operand]));
  for (std::uint32_t& vertex : result) vertex += first_vertex_[operand];
  return result;
}

std::uint32_t Operands::vertex(std::uint32_t halfedge) const {
  const std::uint32_t operand = operand_of_face(halfedge / 3);
  return first_vertex_[operand] + mesh(operand).origin(HalfedgeId(halfedge - 3 * first_face_[operand])).index();
}

PointRef Operands::point_of(std::uint32_t halfedge) const {
  const std::uint32_t operand = operand_of_face(halfedge / 3);
  return mesh(operand).point(mesh(operand).origin(HalfedgeId(halfedge - 3 * first_face_[operand])));
}

std::uint32_t Operands::opposite(std::uint32_t halfedge) const {
  const std::uint32_t operand = operand_of_face(halfedge / 3);
  const std::uint32_t first = 3 * first_face_[operand];
  const HalfedgeId other = mesh(operand).opposite(HalfedgeId(halfedge - first));
  return other.is_valid() ? first + other.index() : kNone;
}

std::uint32_t Operands::edge(std::uint32_t halfedge) const {
  const std::uint32_t operand = operand_of_face(halfedge / 3);
  const std::uint32_t first = 3 * first_face_[operand];
  const HalfedgeId local(halfedge - first);
  if (const HalfedgeId other = mesh(operand).opposite(local); other.is_valid())
    return first + std::min(local, other).index();
  return mesh(operand).is_nonmanifold(local) ? first + mesh(operand).edge_halfedges(local).front().index() : halfedge;
}

void Operands::halfedges_along(std::uint32_t halfedge, std::vector<std::uint32_t>& result) const {
  result.clear();
  const std::uint32_t operand = operand_of_face(halfedge / 3);
  const std::uint32_t first = 3 * first_face_[operand];
  const HalfedgeId local(halfedge - first);
  if (mesh(operand).is_nonmanifold(local)) {
    for (const HalfedgeId h : mesh(operand).edge_halfedges(local)) result.push_back(first + h.index());
    return;
  }
  result.push_back(halfedge);
  if (const HalfedgeId other = mesh(operand).opposite(local); other.is_valid()) {
    result.push_back(first + other.index());
    std::ranges::sort(result);
  }
}

void Operands::halfedges_around_origin(std::uint32_t halfedge, std::vector<std::uint32_t>& result) const {
  result.clear();
  const std::uint32_t operand = operand_of_face(halfedge / 3);
  const std::uint32_t first = 3 * first_face_[operand];
  for (const HalfedgeId h : outgoing_halfedges(mesh(operand), mesh(operand).origin(HalfedgeId(halfedge - first))))
    result.push_back(first + h.index());
}

}  // namespace algebra3d::arrangement
