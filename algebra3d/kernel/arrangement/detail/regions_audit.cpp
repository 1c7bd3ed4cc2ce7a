#include <algorithm>
#include <map>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/regions.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// How often each line is run along from its lower node to its higher one, minus how often the other way.
using NetEdges = std::map<SpaceEdge, int>;

void add_edge(NetEdges& net, NodeId from, NodeId to) {
  net[SpaceEdge::of(from, to)] += from < to ? 1 : -1;
}

class RegionsAudit {
 public:
  RegionsAudit(const Subdivision& subdivision, const std::vector<RegionEdge>& edges, const Regions& regions)
      : subdivision_(subdivision), nodes_(subdivision.complex.nodes), edges_(edges), regions_(regions) {}

  std::vector<std::string> run();

 private:
  bool check_keys();
  bool check_triangles(const Region& region);
  void check_boundary(const Region& region);

  const Subdivision& subdivision_;
  const NodePool& nodes_;
  const std::vector<RegionEdge>& edges_;
  const Regions& regions_;
  Violations violations_;
};

bool RegionsAudit::check_keys() {
  std::vector<RegionKey> expected, found;
  for (const RegionEdge& edge : edges_)
    if (expected.empty() || expected.back() != edge.region) expected.push_back(edge.region);
  for (const Region& region : regions_.regions) found.push_back(region.key);
  return violations_.expect(expected == found, "{} regions are not those of the edges, which are {}", found.size(),
                            expected.size());
}

/// Whether all corners are there.
bool RegionsAudit::check_triangles(const Region& region) {
  const Projection projection = subdivision_.facets.planes[region.key.plane()].projection;
  bool are_there = true, has_exact_corner = false;
  for (const auto& [a, b, c] : regions_.triangles_of(region)) {
    if (!violations_.expect(std::max({a, b, c}) < nodes_.size(), "triangle ({} {} {}) has a corner that is not a node",
                            a, b, c)) {
      are_there = false;
      continue;
    }
    const PointRef p = nodes_[NodeId(a)], q = nodes_[NodeId(b)], r = nodes_[NodeId(c)];
    violations_.expect(orient2d(projection, p, q, r) > 0,
                       "triangle ({} {} {}) in plane {} is not counter-clockwise from the front", a, b, c,
                       region.key.plane().index());
    has_exact_corner = has_exact_corner || !p.is_double() || !q.is_double() || !r.is_double();
  }
  violations_.expect(!are_there || has_exact_corner == region.has_exact_corner,
                     "a region in plane {} does not say whether a corner is not a double", region.key.plane().index());
  return are_there;
}

void RegionsAudit::check_boundary(const Region& region) {
  NetEdges net;
  for (const auto& corners : regions_.triangles_of(region))
    for (std::size_t i = 0; i < 3; ++i) add_edge(net, NodeId(corners[i]), NodeId(corners[(i + 1) % 3]));
  for (const auto& [key, from, to] : edges_)
    if (key == region.key) add_edge(net, to, from);
  for (const auto& [ends, count] : net)
    violations_.expect(count == 0, "a region in plane {}: its triangles and its boundary differ along nodes {} and {}",
                       region.key.plane().index(), ends.u.index(), ends.v.index());
}

std::vector<std::string> RegionsAudit::run() {
  if (!check_keys()) return violations_.take();
  for (const Region& region : regions_.regions)
    if (check_triangles(region)) check_boundary(region);
  return violations_.take();
}

}  // namespace

std::vector<std::string> audit(const Subdivision& subdivision, const std::vector<RegionEdge>& edges,
                               const Regions& regions) {
  return RegionsAudit(subdivision, edges, regions).run();
}

}  // namespace algebra3d::arrangement
