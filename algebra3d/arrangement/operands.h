#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d::arrangement {

inline constexpr std::uint32_t kNone = 0xFFFFFFFF;
/// From so many faces on, a second thread saves more than it costs.
inline constexpr std::uint32_t kWorthAThread = 20000;
/// The same for points and planes that are computed exactly.
inline constexpr std::size_t kPointsWorthAThread = 64;

/// All operands as if they were one mesh: faces, half-edges and vertices are numbered through, those of the first
/// operand first; half-edge 3f + i leaves corner i of face f as in every mesh.
class Operands {
 public:
  /// The meshes must outlive this. Their faces together are at most TriangleMesh::kMaxFaces.
  explicit Operands(std::span<const Operand> operands);

  std::size_t count() const { return operands_.size(); }
  std::uint32_t face_count() const { return first_face_.back(); }
  std::uint32_t vertex_count() const { return first_vertex_.back(); }
  const TriangleMesh& mesh(std::uint32_t operand) const { return *operands_[operand].mesh; }
  std::uint32_t group(std::uint32_t operand) const { return operands_[operand].group; }
  const BoxHierarchy& hierarchy(std::uint32_t operand) const { return *hierarchies_[operand]; }
  std::uint32_t first_face(std::uint32_t operand) const { return first_face_[operand]; }
  std::uint32_t first_vertex(std::uint32_t operand) const { return first_vertex_[operand]; }
  std::uint32_t operand_of_face(std::uint32_t face) const {
    return operands_of_faces_.empty() ? find_operand(face) : operands_of_faces_[face];
  }

  std::uint32_t operand_of_vertex(std::uint32_t vertex) const;

  TriangleRef corners(std::uint32_t face) const;
  /// Their numbers.
  TriangleMesh::Triangle vertices(std::uint32_t face) const;
  /// Null if the mesh does not know it.
  const IntegerPlane* plane(std::uint32_t face) const {
    const std::uint32_t operand = operand_of_face(face);
    return mesh(operand).planes().find(face - first_face_[operand]);
  }
  std::uint32_t vertex(std::uint32_t halfedge) const;
  PointRef point_of(std::uint32_t halfedge) const;
  static std::uint32_t next(std::uint32_t halfedge) { return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1; }
  static std::uint32_t previous(std::uint32_t halfedge) { return halfedge % 3 == 0 ? halfedge + 2 : halfedge - 1; }
  /// The other half-edge of a manifold edge, else kNone.
  std::uint32_t opposite(std::uint32_t halfedge) const;
  /// One half-edge that stands for the edge: the lowest along it.
  std::uint32_t edge(std::uint32_t halfedge) const;
  /// All half-edges along the edge, ascending.
  void halfedges_along(std::uint32_t halfedge, std::vector<std::uint32_t>& result) const;
  /// All half-edges that leave the origin of the half-edge.
  void halfedges_around_origin(std::uint32_t halfedge, std::vector<std::uint32_t>& result) const;

 private:
  std::uint32_t find_operand(std::uint32_t face) const;

  std::span<const Operand> operands_;
  std::vector<std::uint32_t> first_face_, first_vertex_;  // one more than operands
  std::vector<std::uint32_t> operands_of_faces_;  // empty if there are so few operands that they are soon searched
  std::vector<const BoxHierarchy*> hierarchies_;
  std::vector<std::unique_ptr<const BoxHierarchy>> own_hierarchies_;
};

}  // namespace algebra3d::arrangement
