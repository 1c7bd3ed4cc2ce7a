#include "algebra3d/kernel/validity/detail/edges.h"

#include <algorithm>
#include <span>
#include <vector>

#include "algebra3d/kernel/halfedge/topology.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

constexpr std::size_t kHalfedgesPerTask = 32768;

Vec3 middle(const TriangleMesh& mesh, HalfedgeId h) {
  // Halved first: the sum of the largest doubles is not finite.
  return 0.5 * mesh.point(mesh.origin(h)).approx + 0.5 * mesh.point(mesh.target(h)).approx;
}

std::vector<HalfedgeId> boundary_halfedges(const TriangleMesh& mesh) {
  return parallel_collect(mesh.halfedge_count(), kHalfedgesPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<HalfedgeId> boundary;
    for (std::size_t i = begin; i < end; ++i)
      if (mesh.is_boundary(HalfedgeId(i))) boundary.emplace_back(i);
    return boundary;
  });
}

/// `edge` has no opposite half-edges: alone in one direction, both in the same, or more than two.
void check_nonmanifold_edge(const TriangleMesh& mesh, std::span<const HalfedgeId> edge, const SoundFaces& sound,
                            ValidityReport& report) {
  const HalfedgeId first = edge[0];
  if (mesh.origin(first) == mesh.target(first)) return;  // a repeated corner; its triangle is reported as degenerate
  const auto is_sound = [&](HalfedgeId h) { return sound[TriangleMesh::face(h).index()]; };
  if (is_balanced(mesh, edge) && (!std::ranges::all_of(edge, is_sound) || order_around(mesh, edge) != EdgeOrder::mixed))
    return;
  const Defect kind = edge.size() == 2 ? Defect::inconsistent_edge : Defect::nonmanifold_edge;
  const FaceId face = TriangleMesh::face(first), other = TriangleMesh::face(edge[1]);
  report.add({kind, face, other == face ? FaceId() : other, middle(mesh, first)});
}

}  // namespace

void check_edges(const TriangleMesh& mesh, const SoundFaces& sound, ValidityReport& report, const FaceSet& excepted) {
  const auto is_excepted = [&](HalfedgeId h) { return excepted.contains(TriangleMesh::face(h).index()); };
  for (const HalfedgeId h : boundary_halfedges(mesh))
    if (!is_excepted(h)) report.add({Defect::boundary_edge, TriangleMesh::face(h), FaceId(), middle(mesh, h)});
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    if (const auto edge = mesh.nonmanifold_edge(n); !std::ranges::all_of(edge, is_excepted))
      check_nonmanifold_edge(mesh, edge, sound, report);
}

}  // namespace algebra3d
