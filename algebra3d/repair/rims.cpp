#include "algebra3d/repair/rims.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/repair/loop_triangulation.h"

namespace algebra3d {
namespace {

/// An edge along which a facet is missing, in the direction in which that would run.
struct Lack {
  std::uint32_t from, to;
  bool is_boundary;
  bool is_covered = false;
};

class RimCloser {
 public:
  RimCloser(FacetList& facets, const RimLimits& limits, RepairReport& report)
      : facets_(facets), limits_(limits), report_(report) {}

  Status run(const Monitor& monitor);

 private:
  void find_lacks();
  std::vector<std::uint32_t> shortest_loop(std::uint32_t start) const;
  void cover(const std::vector<std::uint32_t>& loop);

  FacetList& facets_;
  RimLimits limits_;
  RepairReport& report_;
  std::vector<Lack> lacks_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> from_;  // numbers of the lacks by their start
  bool is_needed_ = false;
};

void RimCloser::find_lacks() {
  const auto linked = facets_.mesh();
  const TriangleMesh& mesh = *linked;
  bool has_boundary = false, has_others = false;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const HalfedgeId halfedge(h);
    if (!mesh.is_boundary(halfedge)) continue;
    lacks_.push_back({mesh.target(halfedge).index(), mesh.origin(halfedge).index(), true});
    has_boundary = true;
  }
  for (std::size_t n = 0; (has_boundary || limits_.covers_walls) && n < mesh.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh.nonmanifold_edge(n);
    std::uint32_t from = mesh.origin(edge[0]).index(), to = mesh.target(edge[0]).index();
    int balance = 0;
    for (const HalfedgeId h : edge) balance += mesh.origin(h).index() == from ? 1 : -1;
    if (balance > 0) std::swap(from, to);
    for (int i = 0; i < std::abs(balance); ++i) lacks_.push_back({from, to, false});
    has_others = has_others || balance != 0;
  }
  is_needed_ = has_others && (has_boundary || limits_.covers_walls);
  for (std::uint32_t i = 0; is_needed_ && i < lacks_.size(); ++i) from_[lacks_[i].from].push_back(i);
}

/// Lacks that lead from the end of the given one back to its start, that one first; empty if there are none.
std::vector<std::uint32_t> RimCloser::shortest_loop(std::uint32_t start) const {
  constexpr std::size_t kMostVertices = 2000;                     // what is longer is no hole
  using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // length so far, vertex, lack that leads there
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
  std::map<std::uint32_t, std::uint32_t> reached;
  steps.emplace(0, lacks_[start].to, start);
  while (!steps.empty() && reached.size() < kMostVertices) {
    const auto [so_far, vertex, by] = steps.top();
    steps.pop();
    if (!reached.try_emplace(vertex, by).second) continue;
    if (vertex == lacks_[start].from) break;
    const auto next = from_.find(vertex);
    if (next == from_.end()) continue;
    for (const std::uint32_t i : next->second)
      if (!lacks_[i].is_covered)
        steps.emplace(so_far + length(facets_.points[lacks_[i].to] - facets_.points[vertex]), lacks_[i].to, i);
  }
  std::vector<std::uint32_t> loop;
  if (!reached.contains(lacks_[start].from)) return loop;
  for (std::uint32_t at = lacks_[start].from; loop.empty() || loop.back() != start; at = lacks_[loop.back()].from)
    loop.push_back(reached.at(at));
  std::ranges::reverse(loop);
  return loop;
}

void RimCloser::cover(const std::vector<std::uint32_t>& loop) {
  Box3 box;
  Loop corners;
  for (const std::uint32_t i : loop) {
    corners.corners.push_back(facets_.points[lacks_[i].from]);
    box.extend(corners.corners.back());
  }
  corners.beyond = corners.corners;
  const double diameter = length(box.max - box.min);
  if (diameter > limits_.largest) return;
  // A loop on one line closes by itself.
  const std::size_t facet_count = facets_.triangles.size();
  for (const auto& [a, b, c] : triangulate_loop(corners, LoopMeasure::area))
    if (!collinear(corners.corners[a], corners.corners[b], corners.corners[c]))
      facets_.triangles.push_back({lacks_[loop[a]].from, lacks_[loop[b]].from, lacks_[loop[c]].from});
  if (facets_.triangles.size() == facet_count) return;
  facets_.changed();
  report_.add(RepairStep::holes, corners.corners[0], diameter);
}

Status RimCloser::run(const Monitor& monitor) {
  find_lacks();
  if (!is_needed_) return {};
  for (std::uint32_t start = 0; start < lacks_.size(); ++start) {
    if (lacks_[start].is_covered || !(lacks_[start].is_boundary || limits_.covers_walls)) continue;
    RETURN_IF_ERROR(monitor.check());
    const std::vector<std::uint32_t> loop = shortest_loop(start);
    for (const std::uint32_t i : loop) lacks_[i].is_covered = true;
    const bool has_others = std::ranges::any_of(loop, [&](std::uint32_t i) { return !lacks_[i].is_boundary; });
    if (has_others && loop.size() >= 3) cover(loop);
  }
  return {};
}

}  // namespace

Status close_rims(FacetList& facets, const RimLimits& limits, RepairReport& report, const Monitor& monitor) {
  return RimCloser(facets, limits, report).run(monitor);
}

}  // namespace algebra3d
