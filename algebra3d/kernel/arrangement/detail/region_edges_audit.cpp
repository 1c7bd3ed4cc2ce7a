#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/region_edges.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {
namespace {

class RegionEdgesAudit {
 public:
  RegionEdgesAudit(const Subdivision& subdivision, const std::vector<RegionEdge>& edges)
      : subdivision_(subdivision), edges_(edges) {}

  std::vector<std::string> run();

 private:
  /// An end of an edge: 1 where it begins, -1 where it ends.
  struct End {
    RegionKey region;
    NodeId node;
    int excess;
  };

  bool check_edge(const RegionEdge& edge);
  void check_repetitions();
  void check_boundaries();
  bool is_in_plane(NodeId node, PlaneId plane) const {
    const TriangleRef triangle = subdivision_.facets.planes[plane].triangle();
    return orient3d(triangle[0], triangle[1], triangle[2], subdivision_.complex.nodes[node]) == 0;
  }

  const Subdivision& subdivision_;
  const std::vector<RegionEdge>& edges_;
  Violations violations_;
};

/// False if it names what is not there.
bool RegionEdgesAudit::check_edge(const RegionEdge& edge) {
  const auto& [region, from, to] = edge;
  const std::size_t node_count = subdivision_.complex.nodes.size();
  const bool is_there = region.plane().index() < subdivision_.facets.planes.size() && from != to &&
                        from.index() < node_count && to.index() < node_count;
  if (!violations_.expect(is_there, "the edge from node {} to node {} has no two ends or no plane", from.index(),
                          to.index()))
    return false;
  violations_.expect(is_in_plane(from, region.plane()) && is_in_plane(to, region.plane()),
                     "the edge from node {} to node {} is not in the plane {} of its region", from.index(), to.index(),
                     region.plane().index());
  return true;
}

void RegionEdgesAudit::check_repetitions() {
  std::vector<RegionEdge> sorted = edges_;
  std::ranges::sort(sorted);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    violations_.expect(sorted[i - 1] != sorted[i], "a region in plane {} has the edge from node {} to node {} twice",
                       sorted[i].region.plane().index(), sorted[i].from.index(), sorted[i].to.index());
}

void RegionEdgesAudit::check_boundaries() {
  std::vector<End> ends;
  for (const auto& [region, from, to] : edges_) {
    ends.push_back({region, from, 1});
    ends.push_back({region, to, -1});
  }
  const auto place = [](const End& end) { return std::tie(end.region, end.node); };
  std::ranges::sort(ends, {}, place);
  for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
    int excess = 0;
    for (; last < ends.size() && place(ends[last]) == place(ends[first]); ++last) excess += ends[last].excess;
    violations_.expect(excess == 0, "a region in plane {}: {} more edges begin than end at node {}",
                       ends[first].region.plane().index(), excess, ends[first].node.index());
  }
}

std::vector<std::string> RegionEdgesAudit::run() {
  bool are_there = true;
  for (const RegionEdge& edge : edges_) are_there &= check_edge(edge);
  if (!are_there) return violations_.take();
  check_repetitions();
  check_boundaries();
  return violations_.take();
}

}  // namespace

std::vector<std::string> audit(const Subdivision& subdivision, const std::vector<RegionEdge>& edges) {
  return RegionEdgesAudit(subdivision, edges).run();
}

}  // namespace algebra3d::arrangement
