#include "algebra3d/arrangement/detail/uncut_edges.h"

#include <algorithm>

namespace algebra3d::arrangement {

std::vector<UncutEdge> uncut_edges(const Operands& operands, const SegmentComplex& complex, const Patches& patches) {
  std::vector<UncutEdge> result;
  std::vector<InputHalfedgeId> along;
  const auto is_of_patch = [&](InputHalfedgeId h) { return !patches.of_face[Operands::face(h)].is_none(); };
  for (const SegmentId s : complex.segments.ids()) {
    const Segment& segment = complex.segments[s];
    if (segment.edge.is_none()) continue;
    operands.halfedges_along(segment.edge, along);
    if (std::ranges::any_of(along, is_of_patch)) result.push_back({s, segment.edge});
  }
  return result;
}

std::vector<SpaceEdge> space_edges_of(const std::vector<UncutEdge>& uncut_edges, const SubEdges& sub_edges) {
  std::vector<SpaceEdge> edges;
  for (const UncutEdge& edge : uncut_edges) {
    const auto nodes = sub_edges.segments.nodes(edge.segment);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) edges.push_back(SpaceEdge::of(nodes[i], nodes[i + 1]));
  }
  std::ranges::sort(edges);
  return edges;
}

}  // namespace algebra3d::arrangement
