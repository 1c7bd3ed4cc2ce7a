#include "algebra3d/arrangement/outcome_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

namespace algebra3d::arrangement {

OutcomeMesh::OutcomeMesh(const Skeleton& skeleton, const Patches& patches, std::vector<int> kept)
    : skeleton_(skeleton),
      patches_(patches),
      kept_(std::move(kept)),
      new_faces_(skeleton.operands().face_count(), kNone),
      is_fixed_(skeleton.vertices().size()),
      vertices_of_corners_(skeleton.vertices_of_corners()),
      points_of_vertices_(skeleton.vertices().size(), kNone),
      points_of_corners_(skeleton.operands().vertex_count(), kNone),
      planes_(skeleton) {
  const Operands& operands = skeleton_.operands();
  std::uint32_t count = 0;
  for_each_taken_face([&](std::uint32_t operand, FaceId face, bool) {
    new_faces_[operands.first_face(operand) + face.index()] = count++;
    for (const std::uint32_t corner : operands.mesh(operand).triangle(face))
      if (const std::uint32_t vertex = vertices_of_corners_[operands.first_vertex(operand) + corner]; vertex != kNone)
        is_fixed_[vertex] = true;
  });
  origins_.reserve(3 * std::size_t{count});
  opposites_.reserve(3 * std::size_t{count});
}

/// Calls visit(operand, face, is_flipped) for each, in order.
template <typename Visit>
void OutcomeMesh::for_each_taken_face(Visit visit) const {
  const Operands& operands = skeleton_.operands();
  for (std::uint32_t operand = 0; operand < operands.count(); ++operand)
    for (std::uint32_t f = 0; f < operands.mesh(operand).face_count(); ++f)
      if (const int kept = kept_of_face(operands.first_face(operand) + f); kept != 0)
        visit(operand, FaceId(f), kept < 0);
}

void OutcomeMesh::take_faces() {
  for_each_taken_face(
      [&](std::uint32_t operand, FaceId face, bool is_flipped) { take_face(operand, face, is_flipped); });
}

void OutcomeMesh::take_surroundings() {
  for_each_taken_face([&](std::uint32_t operand, FaceId face, bool is_flipped) {
    planes_.take(static_cast<std::uint32_t>(opposites_.size() / 3), operand, face, is_flipped);
    take_opposites(operand, face, is_flipped);
  });
}

void OutcomeMesh::take_face(std::uint32_t operand, FaceId face, bool is_flipped) {
  const std::size_t first = origins_.size();
  for (const std::uint32_t corner : skeleton_.operands().mesh(operand).triangle(face))
    origins_.push_back(point_of_corner(operand, corner));
  if (is_flipped) std::swap(origins_[first + 1], origins_[first + 2]);
}

/// Where an edge ends in a vertex of the arrangement, others may run along it.
void OutcomeMesh::take_opposites(std::uint32_t operand, FaceId face, bool is_flipped) {
  const TriangleMesh& mesh = skeleton_.operands().mesh(operand);
  const TriangleMesh::Triangle corners = mesh.triangle(face);
  std::array<bool, 3> is_free_corner{};
  for (std::size_t i = 0; i < 3; ++i) is_free_corner[i] = is_free(operand, VertexId(corners[i]));
  for (std::uint32_t i = 0; i < 3; ++i) {
    // Turned over, a face has its half-edges in the opposite order.
    const std::uint32_t old = is_flipped ? 2 - i : i;
    const HalfedgeId opposite = mesh.opposite(TriangleMesh::halfedge(face, old));
    if (!is_free_corner[old] || !is_free_corner[(old + 1) % 3] || !opposite.is_valid()) {
      opposites_.push_back(TriangleMesh::kUnlinked);
      continue;
    }
    const std::uint32_t place = opposite.index() % 3;
    opposites_.push_back(
        3 * new_faces_[skeleton_.operands().first_face(operand) + TriangleMesh::face(opposite).index()] +
        (is_flipped ? 2 - place : place));
  }
}

/// True if no other operand has the corner, and its own one has nothing but one fan there.
bool OutcomeMesh::is_free(std::uint32_t operand, VertexId corner) const {
  return vertices_of_corners_[skeleton_.operands().first_vertex(operand) + corner.index()] == kNone &&
         !skeleton_.operands().mesh(operand).is_nonmanifold(corner);
}

void OutcomeMesh::add_region(std::span<const TriangleMesh::Triangle> triangles, std::uint32_t plane, bool is_flipped,
                             bool keeps_plane) {
  const auto first = static_cast<std::uint32_t>(origins_.size() / 3);
  for (TriangleMesh::Triangle triangle : triangles) {
    for (std::uint32_t& corner : triangle) corner = point_of_vertex(corner);
    if (is_flipped) std::swap(triangle[1], triangle[2]);
    origins_.insert(origins_.end(), triangle.begin(), triangle.end());
  }
  opposites_.resize(origins_.size(), TriangleMesh::kUnlinked);
  if (keeps_plane) planes_.add(first, static_cast<std::uint32_t>(origins_.size() / 3), plane, is_flipped);
}

std::uint32_t OutcomeMesh::point_of_vertex(std::uint32_t vertex) {
  std::uint32_t& point = points_of_vertices_[vertex];
  if (point == kNone) point = add_point(skeleton_.vertices()[vertex]);
  return point;
}

std::uint32_t OutcomeMesh::point_of_corner(std::uint32_t operand, std::uint32_t corner) {
  const std::uint32_t number = skeleton_.operands().first_vertex(operand) + corner;
  std::uint32_t& point = points_of_corners_[number];
  if (point == kNone) {
    const std::uint32_t vertex = vertices_of_corners_[number];
    point = vertex != kNone ? point_of_vertex(vertex)
                            : add_point(skeleton_.operands().mesh(operand).point(VertexId(corner)));
  }
  return point;
}

std::uint32_t OutcomeMesh::add_point(const PointRef& point) {
  points_.push_back(point);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

TriangleMesh OutcomeMesh::finish() {
  return {std::move(points_), std::move(origins_), std::move(opposites_), planes_.take_planes()};
}

}  // namespace algebra3d::arrangement
