#include "algebra3d/arrangement/detail/region_edges.h"

#include <algorithm>

namespace algebra3d::arrangement {
namespace {

/// The sub-facets to the left and right of a sub-edge, as far as the result takes them.
struct KeptSides {
  int left, right;
};

KeptSides kept_sides(const SubEdges& sub_edges, const Selection& selection, SubEdgeId sub_edge) {
  const auto kept = [&](Side side) {
    const SubEdgeSide at(sub_edge, side);
    return sub_edges.is_covered(at) ? selection.sub_facet(at) : 0;
  };
  return {kept(Side::left), kept(Side::right)};
}

}  // namespace

std::vector<RegionEdge> region_edges(const Subdivision& subdivision, const Selection& selection) {
  const SubEdges& sub_edges = subdivision.sub_edges;
  std::vector<RegionEdge> edges;
  std::vector<KeptSides> kept;
  sub_edges.for_each_space_edge([&](IdRange<SubEdgeId> edge) {
    kept.clear();
    std::size_t plane_count = 0;
    const auto [u, v] = sub_edges[edge.front()].ends;
    bool is_parted = subdivision.uncut_edges.space_edges.contains({u, v});
    for (const SubEdgeId s : edge) {
      kept.push_back(kept_sides(sub_edges, selection, s));
      const auto& [left, right] = kept.back();
      if (left != 0 || right != 0) ++plane_count;
      is_parted = is_parted || left != right;
    }
    if (plane_count < 2 && !is_parted) return;
    for (auto at = kept.begin(); const SubEdgeId s : edge) {
      const auto& [left, right] = *at++;
      if (left != 0) edges.push_back({{sub_edges[s].plane, left < 0}, u, v});
      if (right != 0) edges.push_back({{sub_edges[s].plane, right < 0}, v, u});
    }
  });
  return edges;
}

}  // namespace algebra3d::arrangement
