#include "algebra3d/kernel/arrangement/detail/result_mesh.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/taken_order.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {

ResultMesh::ResultMesh(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept,
                       std::size_t region_triangles)
    : subdivision_(subdivision),
      runs_(subdivision.operands, subdivision.patches, kept),
      vertices_(subdivision, patch_corners, kept),
      at_nodes_(vertices_.at_nodes()),
      planes_(subdivision) {
  const std::size_t capacity = 3 * (runs_.face_count() + region_triangles);
  for (auto* values : {&mesh_.origins, &mesh_.opposites}) {
    values->reserve(capacity);
    values->resize(3 * runs_.face_count());
  }
  take_patches();
}

void ResultMesh::take_patches() {
  const auto take_points_and_planes = [&] {
    mesh_.points = vertices_.points();
    for (const TakenRun& run : runs_) planes_.take(run);
    mesh_.order = taken_order(subdivision_.operands, runs_);
  };
  const auto take_faces = [&] {
    const std::size_t count = runs_.face_count();
    parallel_for((count + kFacesPerTask - 1) / kFacesPerTask, 1, [&](std::size_t i) {
      this->take_faces(FaceId(i * kFacesPerTask), FaceId(std::min((i + 1) * kFacesPerTask, count)));
    });
    mesh_.outgoing = vertices_.outgoing(runs_);
  };
  parallel_invoke(subdivision_.operands.face_count() >= kFacesWorthATask, take_points_and_planes, take_faces);
}

/// The faces of the result in a range.
void ResultMesh::take_faces(FaceId first, FaceId last) {
  for (const TakenRun* run = &runs_.with(first); first < last; ++run) {
    const std::size_t skipped = first.index() - run->new_first.index();
    const std::size_t count = std::min<std::size_t>(run->count - skipped, last.index() - first.index());
    const FaceId from(run->first.index() + skipped);
    take_corners(*run, from, count);
    take_opposites(*run, from, count);
    first = FaceId(first.index() + count);
  }
}

void ResultMesh::take_corners(const TakenRun& run, FaceId first, std::size_t count) {
  const TriangleMesh& mesh = subdivision_.operands.mesh(run.operand);
  std::uint32_t* origin =
      &mesh_.origins[3 * std::size_t{TriangleMesh::face(run.along(TriangleMesh::halfedge(first))).index()}];
  for (const FaceId face : IdRange(first, FaceId(first.index() + count))) {
    const IndexTriangle corners = mesh.triangle(face);
    for (std::size_t i = 0; i < 3; ++i)
      origin[i] = vertices_[subdivision_.operands.input(run.operand, VertexId(corners[i]))].index();
    if (run.is_flipped) std::swap(origin[1], origin[2]);
    origin += 3;
  }
}

/// As if the faces on the other side of all edges were taken. Where they are not, both ends of the edge are open.
void ResultMesh::take_opposites(const TakenRun& run, FaceId first, std::size_t count) {
  const Operands& operands = subdivision_.operands;
  const TriangleMesh& mesh = operands.mesh(run.operand);
  const TakenRun* beyond = &run;
  for (const HalfedgeId h :
       IdRange(TriangleMesh::halfedge(first), TriangleMesh::halfedge(FaceId(first.index() + count)))) {
    const HalfedgeId opposite = mesh.opposite(h);
    if (!opposite.is_valid()) continue;
    const FaceId face = TriangleMesh::face(opposite);
    if (!beyond->contains(face)) {
      const TakenRun* found = runs_.find(operands.input(run.operand, face));
      if (found == nullptr) continue;
      beyond = found;
    }
    mesh_.opposites[run.along(h).index()] = beyond->along(opposite).index();
  }
}

void ResultMesh::add(const Region& region, std::span<const IndexTriangle> triangles) {
  LargeVector<std::uint32_t>& origins = mesh_.origins;
  const FaceId first(origins.size() / 3);
  std::size_t at = origins.size();
  origins.resize(at + 3 * triangles.size());
  mesh_.opposites.resize(origins.size());
  for (const IndexTriangle& corners : triangles) {
    for (std::size_t i = 0; i < 3; ++i) origins[at + i] = vertex_at(NodeId(corners[i])).index();
    if (region.key.is_flipped()) std::swap(origins[at + 1], origins[at + 2]);
    at += 3;
  }
  if (region.has_exact_corner)
    planes_.add({first, FaceId(origins.size() / 3)}, region.key.plane(), region.key.is_flipped());
}

VertexId ResultMesh::vertex_at(NodeId node) {
  VertexId& vertex = at_nodes_[node];
  if (vertex.is_valid()) return vertex;
  vertex = VertexId(mesh_.points.size());
  mesh_.points.push_back(subdivision_.complex.nodes[node]);
  return vertex;
}

UnlinkedMesh ResultMesh::finish() {
  mesh_.planes = planes_.take_planes();
  return std::move(mesh_);
}

TriangleMesh linked(UnlinkedMesh mesh) {
  return {std::move(mesh.points),   std::move(mesh.origins), std::move(mesh.opposites),
          std::move(mesh.outgoing), std::move(mesh.planes),  std::move(mesh.order)};
}

}  // namespace algebra3d::arrangement
