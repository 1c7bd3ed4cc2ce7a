#include "algebra3d/kernel/arrangement/detail/uncut_edges.h"

#include <algorithm>
#include <numeric>

namespace algebra3d::arrangement {

SpaceEdgeSet::SpaceEdgeSet(std::span<const SpaceEdge> edges, std::size_t node_count) {
  if (edges.empty()) return;
  begins_.resize(node_count + 1);
  ends_.resize(edges.size());
  // Counted, added up, and filled from behind, so that each begin ends where it has to be.
  for (const SpaceEdge& edge : edges) ++begins_[edge.u.index()];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  for (std::uint32_t i = 0; i < edges.size(); ++i) ends_[--begins_[edges[i].u.index()]] = {edges[i].v, i};
}

UncutEdges find_uncut_edges(const Operands& operands, const SegmentComplex& complex, const SubEdges& sub_edges,
                            const Patches& patches) {
  UncutEdges result;
  std::vector<SpaceEdge> space_edges;
  std::vector<InputHalfedgeId> along;
  const auto is_of_patch = [&](InputHalfedgeId h) { return !patches.of_face[Operands::face(h)].is_none(); };
  for (const SegmentId s : complex.segments.ids()) {
    const Segment& segment = complex.segments[s];
    if (segment.edge.is_none()) continue;
    operands.halfedges_along(segment.edge, along);
    if (!std::ranges::any_of(along, is_of_patch)) continue;
    const auto nodes = sub_edges.segments.nodes(s);
    const std::size_t first = result.nodes.size();
    result.nodes.insert(result.nodes.end(), nodes.begin(), nodes.end());
    result.edges.push_back({segment.edge, Slice::from(first, result.nodes)});
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      space_edges.push_back(SpaceEdge::of(nodes[i], nodes[i + 1]));
      result.edge_at.push_back(static_cast<std::uint32_t>(result.edges.size() - 1));
    }
  }
  result.space_edges = SpaceEdgeSet(space_edges, complex.nodes.size());
  return result;
}

}  // namespace algebra3d::arrangement
