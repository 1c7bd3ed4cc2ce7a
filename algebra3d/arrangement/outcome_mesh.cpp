#include "algebra3d/arrangement/outcome_mesh.h"

#include <utility>

#include "algebra3d/halfedge/circulators.h"

namespace algebra3d::arrangement {
namespace {

/// Faces that are turned over have their half-edges in the opposite order.
std::uint32_t turned_over(std::uint32_t halfedge) {
  return halfedge + 2 - 2 * (halfedge % 3);
}

/// Opposites of faces that are turned over like their neighbours.
void turn_over(std::span<std::uint32_t> opposites) {
  for (std::size_t first = 0; first < opposites.size(); first += 3) {
    std::swap(opposites[first], opposites[first + 2]);
    for (std::size_t i = first; i < first + 3; ++i)
      if (opposites[i] != TriangleMesh::kUnlinked) opposites[i] = turned_over(opposites[i]);
  }
}

}  // namespace

OutcomeMesh::OutcomeMesh(const Skeleton& skeleton, const Patches& patches, std::vector<int> kept)
    : skeleton_(skeleton),
      operands_(skeleton.operands()),
      patches_(patches),
      kept_(std::move(kept)),
      new_faces_(operands_.face_count(), kNone),
      is_fixed_(skeleton.vertices().size()),
      vertices_of_corners_(operands_.vertex_count(), kNone),
      points_of_vertices_(skeleton.vertices().size(), kNone),
      points_of_corners_(operands_.vertex_count(), kNone),
      planes_(skeleton) {
  find_runs();
  find_fixed_vertices();
  const std::size_t count = runs_.empty() ? 0 : runs_.back().new_first + runs_.back().count;
  // Regions mostly have no more triangles than the facets that they were cut from.
  const std::size_t room = 3 * (count + skeleton.facets().face_count());
  for (auto* values : {&origins_, &opposites_}) {
    values->reserve(room);
    values->resize(3 * count);
  }
  points_.reserve(count / 2 + skeleton.vertices().size());
}

void OutcomeMesh::find_runs() {
  std::uint32_t count = 0;
  for (std::uint32_t operand = 0; operand < operands_.count(); ++operand) {
    const std::uint32_t begin = operands_.first_face(operand), end = operands_.first_face(operand + 1);
    for (std::uint32_t first = begin, last = begin; first < end; first = last) {
      const int kept = kept_of_face(first);
      while (last < end && kept_of_face(last) == kept) ++last;
      if (kept == 0) continue;
      runs_.push_back({operand, first - begin, count, last - first, kept < 0});
      for (std::uint32_t face = first; face < last; ++face) new_faces_[face] = count++;
    }
  }
}

void OutcomeMesh::find_fixed_vertices() {
  for (const auto& [corner, vertex] : skeleton_.corners()) {
    vertices_of_corners_[corner] = vertex;
    const std::uint32_t operand = operands_.operand_of_vertex(corner);
    const TriangleMesh& mesh = operands_.mesh(operand);
    for (const FaceId face : faces_around(mesh, VertexId(corner - operands_.first_vertex(operand))))
      if (new_faces_[operands_.first_face(operand) + face.index()] != kNone) is_fixed_[vertex] = true;
  }
}

void OutcomeMesh::take_faces() {
  for (const TakenRun& run : runs_) take_faces_of(run);
}

void OutcomeMesh::take_faces_of(const TakenRun& run) {
  const TriangleMesh& mesh = operands_.mesh(run.operand);
  std::uint32_t* origin = &origins_[3 * std::size_t{run.new_first}];
  for (std::uint32_t face = run.first; face < run.first + run.count; ++face, origin += 3) {
    const TriangleMesh::Triangle corners = mesh.triangle(FaceId(face));
    for (std::size_t i = 0; i < 3; ++i) origin[i] = point_of_corner(run.operand, corners[i]);
    if (run.is_flipped) std::swap(origin[1], origin[2]);
  }
}

/// Where an edge ends in a vertex of the arrangement, others may run along it; and an operand may have several fans at
/// a corner, of which the result need not have all.
void OutcomeMesh::take_surroundings() {
  for (const TakenRun& run : runs_) {
    take_opposites_of(run);
    planes_.take(run);
  }
  for (const auto& [corner, vertex] : skeleton_.corners()) {
    const std::uint32_t operand = operands_.operand_of_vertex(corner);
    unlink_around(operand, VertexId(corner - operands_.first_vertex(operand)));
  }
  for (std::uint32_t operand = 0; operand < operands_.count(); ++operand)
    for (const VertexId corner : operands_.mesh(operand).nonmanifold_vertices()) unlink_around(operand, corner);
}

/// As if the faces on the other side of all edges were taken. Where they are not, the ends of the edge are vertices of
/// the arrangement.
void OutcomeMesh::take_opposites_of(const TakenRun& run) {
  const TriangleMesh& mesh = operands_.mesh(run.operand);
  const std::uint32_t* new_faces = &new_faces_[operands_.first_face(run.operand)];
  std::uint32_t* next = &opposites_[3 * std::size_t{run.new_first}];
  const std::uint32_t begin = 3 * run.first, end = 3 * (run.first + run.count);
  for (std::uint32_t h = begin; h < end; ++h) {
    const HalfedgeId opposite = mesh.opposite(HalfedgeId(h));
    const std::uint32_t face = opposite.index() / 3;
    *next++ = opposite.is_valid() ? 3 * (new_faces[face] - face) + opposite.index() : TriangleMesh::kUnlinked;
  }
  if (run.is_flipped)
    turn_over(std::span(opposites_).subspan(3 * std::size_t{run.new_first}, 3 * std::size_t{run.count}));
}

/// The edges that end in the corner are to be looked for.
void OutcomeMesh::unlink_around(std::uint32_t operand, VertexId corner) {
  for (const HalfedgeId outgoing : outgoing_halfedges(operands_.mesh(operand), corner)) {
    const std::uint32_t face = operands_.first_face(operand) + TriangleMesh::face(outgoing).index();
    if (new_faces_[face] == kNone) continue;
    const bool is_flipped = kept_of_face(face) < 0;
    for (const HalfedgeId h : {outgoing, TriangleMesh::prev(outgoing)}) {
      const std::uint32_t taken = 3 * new_faces_[face] + h.index() % 3;
      opposites_[is_flipped ? turned_over(taken) : taken] = TriangleMesh::kUnlinked;
    }
  }
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
  const std::uint32_t number = operands_.first_vertex(operand) + corner;
  std::uint32_t& point = points_of_corners_[number];
  if (point == kNone) {
    const std::uint32_t vertex = vertices_of_corners_[number];
    point = vertex != kNone ? point_of_vertex(vertex) : add_point(operands_.mesh(operand).point(VertexId(corner)));
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
