#include "algebra3d/kernel/repair/detail/vertex_merging.h"

#include <algorithm>
#include <map>
#include <vector>

#include "algebra3d/kernel/repair/detail/boundary_edges.h"
#include "base/disjoint_ids.h"

namespace algebra3d {
namespace {

double distance(const IndexedSoup& soup, VertexId a, VertexId b) {
  return length(soup.point(a) - soup.point(b));
}

/// Two vertices that may be merged.
struct NearPair {
  double distance;
  VertexId a, b;

  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// Sets of vertices that are merged into one, each named by the lowest.
class VertexMerging {
 public:
  VertexMerging(const IndexedSoup& soup, const BoundaryEdges& boundary, double tolerance);

  /// Pairs of boundary vertices within their reach, nearest first.
  std::vector<NearPair> near_pairs() const;
  void merge(const std::vector<NearPair>& pairs);
  VertexId target(VertexId vertex) { return sets_.find(vertex); }

 private:
  void find_neighbours();
  void merge(VertexId a, VertexId b);
  bool share_a_triangle(VertexId a, VertexId b);
  std::vector<VertexId>& members(VertexId set);

  const IndexedSoup& soup_;
  const BoundaryEdges& boundary_;
  double tolerance_;
  DisjointIds<VertexId> sets_;
  IdVector<VertexId, double> reach_;  // no vertex is merged with one farther away
  std::map<VertexId, std::vector<VertexId>> neighbours_, members_;
};

VertexMerging::VertexMerging(const IndexedSoup& soup, const BoundaryEdges& boundary, double tolerance)
    : soup_(soup),
      boundary_(boundary),
      tolerance_(tolerance),
      sets_(soup.points.size()),
      reach_(soup.points.size(), tolerance) {
  for (const BoundaryEdge& edge : boundary.edges) {
    const double third = distance(soup, edge.from, edge.to) / 3;
    reach_[edge.from] = std::min(reach_[edge.from], third);
    reach_[edge.to] = std::min(reach_[edge.to], third);
  }
}

std::vector<NearPair> VertexMerging::near_pairs() const {
  const auto tree = boundary_.vertex_tree(soup_);
  std::vector<NearPair> pairs;
  for (const VertexId a : boundary_.vertices)
    for (const std::uint32_t v : tree.window(widened(Box3::of(soup_.point(a)), reach_[a]))) {
      const VertexId b(v);
      const double apart = distance(soup_, a, b);
      if (a < b && apart <= std::min(reach_[a], reach_[b])) pairs.push_back({apart, a, b});
    }
  std::ranges::sort(pairs);
  return pairs;
}

/// Of each boundary vertex: the other corners of its triangles.
void VertexMerging::find_neighbours() {
  for (const TriangleMesh::Triangle& triangle : soup_.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (const VertexId vertex(triangle[i]); std::ranges::binary_search(boundary_.vertices, vertex))
        for (std::size_t k = 1; k < 3; ++k) neighbours_[vertex].emplace_back(triangle[(i + k) % 3]);
}

void VertexMerging::merge(const std::vector<NearPair>& pairs) {
  find_neighbours();
  for (const NearPair& pair : pairs) merge(pair.a, pair.b);
}

void VertexMerging::merge(VertexId a, VertexId b) {
  a = sets_.find(a);
  b = sets_.find(b);
  if (a == b) return;
  if (a > b) std::swap(a, b);
  const auto is_too_far = [&](VertexId member) { return distance(soup_, member, a) > tolerance_; };
  if (std::ranges::any_of(members(b), is_too_far) || share_a_triangle(a, b)) return;
  sets_.unite(a, b);
  auto& merged = members(a);
  merged.insert(merged.end(), members_[b].begin(), members_[b].end());
  members_.erase(b);
}

/// True if a triangle has corners in both sets.
bool VertexMerging::share_a_triangle(VertexId a, VertexId b) {
  for (const VertexId member : members(a))
    for (const VertexId neighbour : neighbours_[member])
      if (sets_.find(neighbour) == b) return true;
  return false;
}

std::vector<VertexId>& VertexMerging::members(VertexId set) {
  auto& list = members_[set];
  if (list.empty()) list.push_back(set);
  return list;
}

}  // namespace

void merge_boundary_vertices(IndexedSoup& soup, double tolerance, RepairReport& report) {
  const BoundaryEdges boundary(soup);
  VertexMerging merging(soup, boundary, tolerance);
  const std::vector<NearPair> pairs = merging.near_pairs();
  if (pairs.empty()) return;
  merging.merge(pairs);
  bool has_merged = false;
  for (const VertexId v : boundary.vertices) {
    const VertexId target = merging.target(v);
    if (target == v) continue;
    has_merged = true;
    report.add(RepairStep::gaps, soup.point(v), distance(soup, v, target));
  }
  if (!has_merged) return;
  for (TriangleMesh::Triangle& triangle : soup.triangles)
    for (std::uint32_t& corner : triangle) corner = merging.target(VertexId(corner)).index();
  soup.changed();
}

}  // namespace algebra3d
