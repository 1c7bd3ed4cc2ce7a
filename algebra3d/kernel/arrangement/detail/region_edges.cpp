#include "algebra3d/kernel/arrangement/detail/region_edges.h"

#include <algorithm>

namespace algebra3d::arrangement {
namespace {

/// How the result takes the sub-facets to the left and right of a sub-edge.
struct KeptSides {
  int left, right;
};

KeptSides kept_sides(const Selection& selection, SubEdgeId sub_edge) {
  return {selection.sub_facets[{sub_edge, Side::left}], selection.sub_facets[{sub_edge, Side::right}]};
}

/// True if the result has an edge along these sub-edges, all of one space edge.
bool has_edge_along(const Subdivision& subdivision, const Selection& selection, IdRange<SubEdgeId> edge) {
  std::size_t plane_count = 0;
  bool is_parted = false;
  for (const SubEdgeId s : edge) {
    const auto [left, right] = kept_sides(selection, s);
    if (left != 0 || right != 0) ++plane_count;
    is_parted = is_parted || left != right;
  }
  if (plane_count >= 2 || is_parted) return true;
  return plane_count == 1 && subdivision.uncut_edges.space_edges.contains(subdivision.sub_edges[edge.front()].ends);
}

}  // namespace

std::vector<RegionEdge> region_edges(const Subdivision& subdivision, const Selection& selection) {
  const SubEdges& sub_edges = subdivision.sub_edges;
  std::vector<RegionEdge> edges;
  // Nearly all sides that are kept bound a region.
  const auto& sides = selection.sub_facets;
  edges.reserve(sides.size() - static_cast<std::size_t>(std::count(sides.begin(), sides.end(), 0)));
  sub_edges.for_each_space_edge([&](IdRange<SubEdgeId> edge) {
    if (!has_edge_along(subdivision, selection, edge)) return;
    const auto [u, v] = sub_edges[edge.front()].ends;
    for (const SubEdgeId s : edge) {
      const auto [left, right] = kept_sides(selection, s);
      if (left != 0) edges.push_back({{sub_edges[s].plane, left < 0}, u, v});
      if (right != 0) edges.push_back({{sub_edges[s].plane, right < 0}, v, u});
    }
  });
  return edges;
}

}  // namespace algebra3d::arrangement
