#include "algebra3d/kernel/repair/detail/missing_halfedges.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <queue>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"

namespace algebra3d {

MissingHalfedges::MissingHalfedges(const TriangleMesh& mesh) {
  add_boundary(mesh);
  add_nonmanifold(mesh);
}

void MissingHalfedges::add_boundary(const TriangleMesh& mesh) {
  std::vector<bool> ends_at_interface(mesh.halfedge_count());
  for (const BoundaryLoop& run : boundary_loops(mesh))
    for (const HalfedgeId h : run.halfedges) ends_at_interface[h.index()] = !run.is_closed;
  for (const HalfedgeId h : halfedges(mesh)) {
    if (!mesh.is_boundary(h)) continue;
    add({mesh.target(h), mesh.origin(h), true, ends_at_interface[h.index()]});
    has_boundary = true;
  }
}

void MissingHalfedges::add_nonmanifold(const TriangleMesh& mesh) {
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh.nonmanifold_edge(n);
    VertexId from = mesh.origin(edge[0]), to = mesh.target(edge[0]);
    int balance = 0;
    for (const HalfedgeId h : edge) balance += mesh.origin(h) == from ? 1 : -1;
    if (balance > 0) std::swap(from, to);
    for (int i = 0; i < std::abs(balance); ++i) add({from, to, false});
    has_nonmanifold = has_nonmanifold || balance != 0;
  }
}

void MissingHalfedges::add(const MissingHalfedge& edge) {
  from_[edge.from].push_back(edges.next_id());
  edges.push_back(edge);
}

void MissingHalfedges::add_chords(const TriangleMesh& mesh) {
  const auto is_end = [&](VertexId vertex) { return from_.contains(vertex); };
  std::vector<MissingHalfedge> chords;
  for (const HalfedgeId h : halfedges(mesh)) {
    if (!is_end(mesh.origin(h)) || !is_end(mesh.target(h))) continue;
    const bool is_possible = mesh.opposite(h).is_valid() || (mesh.is_nonmanifold(h) && mesh.edge_halfedges(h)[0] == h);
    if (is_possible) chords.push_back({mesh.origin(h), mesh.target(h), false, false, true});
  }
  for (const MissingHalfedge& chord : chords) add(chord);
}

/// A way from the end of the first half-edge to a vertex.
struct MissingHalfedges::Step {
  double length;
  VertexId vertex;
  MissingId by;  ///< leads to the vertex

  friend auto operator<=>(const Step&, const Step&) = default;
};

/// A chord does not lead back along what was before it.
bool MissingHalfedges::is_passable(const MissingHalfedge& edge, const MissingHalfedge& before, Way way) const {
  const bool leads_back = edge.is_chord && edge.to == before.from;
  return (way == Way::any || edge.is_boundary) && !edge.is_covered && !leads_back;
}

std::span<const MissingId> MissingHalfedges::leaving(VertexId vertex) const {
  const auto known = from_.find(vertex);
  return known == from_.end() ? std::span<const MissingId>() : std::span(known->second);
}

std::vector<MissingId> MissingHalfedges::shortest_loop(MissingId start, const std::vector<Vec3>& points,
                                                       Way way) const {
  constexpr std::size_t kMostVertices = 2000;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
  std::map<VertexId, MissingId> reached;
  steps.push({0, edges[start].to, start});
  while (!steps.empty() && reached.size() < kMostVertices) {
    const Step step = steps.top();
    steps.pop();
    if (!reached.try_emplace(step.vertex, step.by).second) continue;
    if (step.vertex == edges[start].from) break;
    for (const MissingId next : leaving(step.vertex)) {
      if (!is_passable(edges[next], edges[step.by], way)) continue;
      const VertexId to = edges[next].to;
      steps.push({step.length + length(points[to.index()] - points[step.vertex.index()]), to, next});
    }
  }
  std::vector<MissingId> loop;
  if (!reached.contains(edges[start].from)) return loop;
  for (VertexId at = edges[start].from; loop.empty() || loop.back() != start; at = edges[loop.back()].from)
    loop.push_back(reached.at(at));
  std::ranges::reverse(loop);
  return loop;
}

MissingId MissingHalfedges::find(VertexId from, VertexId to) const {
  for (const MissingId i : leaving(from))
    if (edges[i].to == to && !edges[i].is_chord) return i;
  return MissingId::none();
}

}  // namespace algebra3d
