#include "algebra3d/arrangement/detail/result_mesh.h"

#include <utility>

#include "algebra3d/halfedge/circulators.h"

namespace algebra3d::arrangement {
namespace {

/// The half-edge of a face that is flipped: its half-edges come in the opposite order.
HalfedgeId flipped(HalfedgeId halfedge) {
  return HalfedgeId(halfedge.index() + 2 - 2 * (halfedge.index() % 3));
}

/// Flips the opposites of faces that are flipped as their neighbours are.
void flip_opposites(std::span<std::uint32_t> opposites) {
  for (std::size_t first = 0; first < opposites.size(); first += 3) {
    std::swap(opposites[first], opposites[first + 2]);
    for (std::uint32_t& opposite : opposites.subspan(first, 3))
      if (opposite != TriangleMesh::kUnlinked) opposite = flipped(HalfedgeId(opposite)).index();
  }
}

}  // namespace

ResultMesh::ResultMesh(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept)
    : subdivision_(subdivision),
      operands_(subdivision.operands),
      patch_corners_(patch_corners),
      kept_(kept),
      new_faces_(operands_.face_count()),
      at_nodes_(subdivision.complex.nodes.size()),
      at_vertices_(operands_.vertex_count()),
      planes_(subdivision) {
  find_runs();
  const std::size_t count = runs_.empty() ? 0 : runs_.back().new_first.index() + runs_.back().count;
  // Regions mostly have no more triangles than the facets that they were cut from.
  const std::size_t capacity = 3 * (count + subdivision.facets.faces.size());
  for (auto* values : {&origins_, &opposites_}) {
    values->reserve(capacity);
    values->resize(3 * count);
  }
  points_.reserve(count / 2 + subdivision.complex.nodes.size());
}

void ResultMesh::find_runs() {
  FaceId new_face(0);
  for (const OperandId operand : operands_.ids())
    for (const InputFaceId face : operands_.faces(operand)) {
      const int kept_as = kept(face);
      if (kept_as == 0) continue;
      const FaceId local = operands_.in_mesh(operand, face);
      const bool continues = !runs_.empty() && runs_.back().operand == operand &&
                             runs_.back().first.index() + runs_.back().count == local.index() &&
                             runs_.back().is_flipped == (kept_as < 0);
      if (!continues) runs_.push_back({operand, local, new_face, 0, kept_as < 0});
      ++runs_.back().count;
      new_faces_[face] = new_face;
      new_face = FaceId(new_face.index() + 1);
    }
}

void ResultMesh::take_faces() {
  for (const TakenRun& run : runs_) take_faces_of(run);
}

void ResultMesh::take_faces_of(const TakenRun& run) {
  const TriangleMesh& mesh = operands_.mesh(run.operand);
  std::uint32_t* origin = &origins_[3 * std::size_t{run.new_first.index()}];
  for (const FaceId face : IdRange(run.first, FaceId(run.first.index() + run.count))) {
    const IndexTriangle corners = mesh.triangle(face);
    for (std::size_t i = 0; i < 3; ++i) origin[i] = vertex_at(run.operand, VertexId(corners[i])).index();
    if (run.is_flipped) std::swap(origin[1], origin[2]);
    origin += 3;
  }
}

/// Where an edge ends in a node, others may run along it; and an operand may have several fans at a vertex, of which
/// the result need not have all.
void ResultMesh::take_surroundings() {
  for (const TakenRun& run : runs_) {
    take_opposites_of(run);
    planes_.take(run);
  }
  for (const auto& [vertex, node] : subdivision_.complex.nodes_of_vertices) {
    const OperandId operand = operands_.operand_of(vertex);
    unlink_around(operand, operands_.in_mesh(operand, vertex));
  }
  for (const OperandId operand : operands_.ids())
    for (const VertexId vertex : operands_.mesh(operand).nonmanifold_vertices()) unlink_around(operand, vertex);
}

/// As if the faces on the other side of all edges were taken. Where they are not, the ends of the edge are nodes.
void ResultMesh::take_opposites_of(const TakenRun& run) {
  const TriangleMesh& mesh = operands_.mesh(run.operand);
  const std::size_t begin = 3 * std::size_t{run.new_first.index()}, size = 3 * run.count;
  std::uint32_t* next = &opposites_[begin];
  for (const HalfedgeId h :
       IdRange(TriangleMesh::halfedge(run.first), TriangleMesh::halfedge(FaceId(run.first.index() + run.count)))) {
    const HalfedgeId opposite = mesh.opposite(h);
    const FaceId face = TriangleMesh::face(opposite);
    *next++ = opposite.is_valid()
                  ? 3 * (new_faces_[operands_.input(run.operand, face)].index() - face.index()) + opposite.index()
                  : TriangleMesh::kUnlinked;
  }
  if (run.is_flipped) flip_opposites(std::span(opposites_).subspan(begin, size));
}

/// The edges that end in the vertex are to be looked for.
void ResultMesh::unlink_around(OperandId operand, VertexId vertex) {
  for (const HalfedgeId outgoing : outgoing_halfedges(operands_.mesh(operand), vertex)) {
    const InputFaceId face = operands_.input(operand, TriangleMesh::face(outgoing));
    if (!new_faces_[face].is_valid()) continue;
    const bool is_flipped = kept(face) < 0;
    for (const HalfedgeId h : {outgoing, TriangleMesh::prev(outgoing)}) {
      const HalfedgeId taken = TriangleMesh::halfedge(new_faces_[face], h.index() % 3);
      opposites_[(is_flipped ? flipped(taken) : taken).index()] = TriangleMesh::kUnlinked;
    }
  }
}

void ResultMesh::add(const Region& region) {
  const FaceId first(origins_.size() / 3);
  for (const IndexTriangle& corners : region.triangles) {
    const std::size_t at = origins_.size();
    for (const std::uint32_t node : corners) origins_.push_back(vertex_at(NodeId(node)).index());
    if (region.key.is_flipped) std::swap(origins_[at + 1], origins_[at + 2]);
  }
  opposites_.resize(origins_.size(), TriangleMesh::kUnlinked);
  if (region.has_exact_corner)
    planes_.add({first, FaceId(origins_.size() / 3)}, region.key.plane, region.key.is_flipped);
}

VertexId ResultMesh::vertex_at(NodeId node) {
  VertexId& vertex = at_nodes_[node];
  if (!vertex.is_valid()) vertex = add_point(subdivision_.complex.nodes[node]);
  return vertex;
}

VertexId ResultMesh::vertex_at(OperandId operand, VertexId vertex) {
  const InputVertexId input = operands_.input(operand, vertex);
  VertexId& known = at_vertices_[input];
  if (known.is_valid()) return known;
  const NodeId node = patch_corners_.node_at(input);
  known = node.is_none() ? add_point(operands_.mesh(operand).point(vertex)) : vertex_at(node);
  return known;
}

VertexId ResultMesh::add_point(const PointRef& point) {
  points_.push_back(point);
  return VertexId(points_.size() - 1);
}

TriangleMesh ResultMesh::finish() {
  return {std::move(points_), std::move(origins_), std::move(opposites_), planes_.take_planes()};
}

}  // namespace algebra3d::arrangement
