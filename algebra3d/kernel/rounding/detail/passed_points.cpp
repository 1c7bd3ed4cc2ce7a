#include "algebra3d/kernel/rounding/detail/passed_points.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/rounding/detail/facet_outlines.h"
#include "algebra3d/kernel/search/boxes.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// Says whether a point is a corner of a facet along a chain.
class CommonFacets {
 public:
  explicit CommonFacets(const FacetOutlines& outlines) {
    for (const OutlineChain& side : outlines.outline_chains()) {
      const auto [from, to] = outlines.chains().ends({side.chain, 0});
      facets_of_points_.emplace_back(from, side.facet);
      facets_of_points_.emplace_back(to, side.facet);
      facets_of_chains_.emplace_back(side.chain, side.facet);
    }
    std::ranges::sort(facets_of_points_);
    std::ranges::sort(facets_of_chains_);
  }

  bool is_any(ChainId chain, PointId point) const {
    auto place = std::ranges::lower_bound(facets_of_chains_, std::pair(chain, CoplanarFacetId(0)));
    for (; place != facets_of_chains_.end() && place->first == chain; ++place)
      if (std::ranges::binary_search(facets_of_points_, std::pair(point, place->second))) return true;
    return false;
  }

 private:
  std::vector<std::pair<PointId, CoplanarFacetId>> facets_of_points_;
  std::vector<std::pair<ChainId, CoplanarFacetId>> facets_of_chains_;
};

}  // namespace

void route_through_passed_points(FacetOutlines& outlines, const Monitor& monitor) {
  const MovedPoints& points = outlines.points();
  EdgeChains& chains = outlines.chains();
  IdVector<ChainId, double> movements(chains.ids().size());
  IdVector<PointId, bool> is_corner(points.points.size());
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const ChainId chain : chains.ids()) {
    const auto [from, to] = chains.ends({chain, 0});
    movements[chain] = std::max(points.movements[from], points.movements[to]);
    is_corner[from] = is_corner[to] = true;
    const Box3 box = unite(Box3::of(points.points[from]), Box3::of(points.points[to]));
    entries.push_back({padded(box, movements[chain]), chain.index()});
  }
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
  std::optional<CommonFacets> common;  // hardly ever asked for
  for (const PointId point : points.points.ids()) {
    if (!is_corner[point]) continue;
    if (monitor.is_cancelled()) return;
    const double movement = points.movements[point];
    for (const std::uint32_t number : tree.window(padded(Box3::of(points.points[point]), movement))) {
      const ChainId chain(number);
      const double reach = movement + movements[chain];
      if (!(reach > 0 && chains.distance({chain, 0}, point) <= reach)) continue;
      if (!common) common.emplace(outlines);
      if (common->is_any(chain, point)) chains.route_through({chain, 0}, point);
    }
  }
}

}  // namespace algebra3d
