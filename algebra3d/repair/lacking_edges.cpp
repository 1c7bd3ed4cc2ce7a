#include "algebra3d/repair/lacking_edges.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "algebra3d/halfedge/topology.h"

namespace algebra3d {

LackingEdges::LackingEdges(const TriangleMesh& mesh) {
  std::vector<bool> ends_at_wall(mesh.halfedge_count());
  for (const BoundaryLoop& run : boundary_loops(mesh))
    for (const HalfedgeId h : run.halfedges) ends_at_wall[h.index()] = !run.is_closed;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const HalfedgeId halfedge(h);
    if (!mesh.is_boundary(halfedge)) continue;
    add({mesh.target(halfedge).index(), mesh.origin(halfedge).index(), true, ends_at_wall[h]});
    has_boundary = true;
  }
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh.nonmanifold_edge(n);
    std::uint32_t from = mesh.origin(edge[0]).index(), to = mesh.target(edge[0]).index();
    int balance = 0;
    for (const HalfedgeId h : edge) balance += mesh.origin(h).index() == from ? 1 : -1;
    if (balance > 0) std::swap(from, to);
    for (int i = 0; i < std::abs(balance); ++i) add({from, to, false});
    has_others = has_others || balance != 0;
  }
}

void LackingEdges::add(const LackingEdge& edge) {
  from_[edge.from].push_back(static_cast<std::uint32_t>(edges.size()));
  edges.push_back(edge);
}

void LackingEdges::add_chords(const TriangleMesh& mesh) {
  const auto is_end = [&](VertexId vertex) { return from_.contains(vertex.index()); };
  std::vector<LackingEdge> chords;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const HalfedgeId halfedge(h);
    if (!is_end(mesh.origin(halfedge)) || !is_end(mesh.target(halfedge))) continue;
    const bool is_even = mesh.opposite(halfedge).is_valid() ||
                         (mesh.is_nonmanifold(halfedge) && mesh.edge_halfedges(halfedge)[0] == halfedge);
    if (is_even) chords.push_back({mesh.origin(halfedge).index(), mesh.target(halfedge).index(), false, false, true});
  }
  for (const LackingEdge& chord : chords) add(chord);
}

std::vector<std::uint32_t> LackingEdges::shortest_loop(std::uint32_t start, const std::vector<Vec3>& points,
                                                       Way way) const {
  constexpr std::size_t kMostVertices = 2000;                     // what is longer is no hole
  using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // length so far, vertex, edge that leads there
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
  std::map<std::uint32_t, std::uint32_t> reached;
  steps.emplace(0, edges[start].to, start);
  while (!steps.empty() && reached.size() < kMostVertices) {
    const auto [so_far, vertex, by] = steps.top();
    steps.pop();
    if (!reached.try_emplace(vertex, by).second) continue;
    if (vertex == edges[start].from) break;
    const auto next = from_.find(vertex);
    if (next == from_.end()) continue;
    for (const std::uint32_t i : next->second) {
      const bool leads_back = edges[i].is_chord && edges[i].to == edges[by].from;
      const bool is_open_to = way == Way::any || edges[i].is_boundary;
      if (is_open_to && !edges[i].is_covered && !leads_back)
        steps.emplace(so_far + length(points[edges[i].to] - points[vertex]), edges[i].to, i);
    }
  }
  std::vector<std::uint32_t> loop;
  if (!reached.contains(edges[start].from)) return loop;
  for (std::uint32_t at = edges[start].from; loop.empty() || loop.back() != start; at = edges[loop.back()].from)
    loop.push_back(reached.at(at));
  std::ranges::reverse(loop);
  return loop;
}

std::uint32_t LackingEdges::find(std::uint32_t from, std::uint32_t to) const {
  const auto known = from_.find(from);
  if (known == from_.end()) return kNone;
  for (const std::uint32_t i : known->second)
    if (edges[i].to == to && !edges[i].is_chord) return i;
  return kNone;
}

}  // namespace algebra3d
