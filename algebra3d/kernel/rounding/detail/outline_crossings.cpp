#include "algebra3d/kernel/rounding/detail/outline_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "algebra3d/base/box3.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// No edge is led farther aside, to avoid a crossing, than by so many times the largest movement of a vertex.
constexpr double kFarthestDetour = 2;

class CrossingResolver {
 public:
  explicit CrossingResolver(FacetOutlines& outlines) : outlines_(outlines), chains_(outlines.chains()) {}

  void run(const std::vector<OutlineLink>& links, const Monitor& monitor);
  std::vector<CoplanarFacetId> given_up() && { return std::move(given_up_); }

 private:
  void resolve(CoplanarFacetId facet, ChainLink one, ChainLink other);
  bool route_through_inner_end(CoplanarFacetId facet, ChainLink link, ChainLink crossing);
  bool cross(CoplanarFacetId facet, ChainLink one, ChainLink other) const;
  void route(CoplanarFacetId facet, ChainLink link, PointId point);
  Box3 box_of_link(const OutlineLink& link) const;

  FacetOutlines& outlines_;
  EdgeChains& chains_;
  std::vector<CoplanarFacetId> given_up_;
};

/// Routes a link through a point, unless that is too far aside.
void CrossingResolver::route(CoplanarFacetId facet, ChainLink link, PointId point) {
  const double detour = chains_.detour(link.chain) + chains_.distance(link, point);
  if (detour <= kFarthestDetour * outlines_.points().largest_movement)
    chains_.route_through(link, point);
  else
    given_up_.push_back(facet);
}

/// Routes the first link through an end of the other that lies on it. False if there is none.
bool CrossingResolver::route_through_inner_end(CoplanarFacetId facet, ChainLink link, ChainLink crossing) {
  const auto [from, to] = chains_.ends(link);
  const auto lies_inside = [&, from = from, to = to](PointId end) {
    return end != from && end != to &&
           outlines_.orientation(outlines_.facets().projection(facet), from, to, end) == 0 &&
           std::isfinite(chains_.distance(link, end));
  };
  const auto [a, b] = chains_.ends(crossing);
  if (!lies_inside(a) && !lies_inside(b)) return false;
  route(facet, link, lies_inside(a) ? a : b);
  return true;
}

/// True if the ends of each link lie on different sides of the other one.
bool CrossingResolver::cross(CoplanarFacetId facet, ChainLink one, ChainLink other) const {
  const Projection plane = outlines_.facets().projection(facet);
  const auto separates = [&](const std::pair<PointId, PointId>& line, const std::pair<PointId, PointId>& ends) {
    return outlines_.orientation(plane, line.first, line.second, ends.first) *
               outlines_.orientation(plane, line.first, line.second, ends.second) <
           0;
  };
  return separates(chains_.ends(one), chains_.ends(other)) && separates(chains_.ends(other), chains_.ends(one));
}

/// Where two links cross, one is routed through that end of the other which is nearest to it.
void CrossingResolver::resolve(CoplanarFacetId facet, ChainLink one, ChainLink other) {
  if (route_through_inner_end(facet, one, other) || route_through_inner_end(facet, other, one)) return;
  if (!cross(facet, one, other)) return;
  const auto [p, q] = chains_.ends(one);
  const auto [r, s] = chains_.ends(other);
  const std::array<std::pair<ChainLink, PointId>, 4> ways{{{one, r}, {one, s}, {other, p}, {other, q}}};
  const auto distance = [&](const auto& way) { return chains_.distance(way.first, way.second); };
  const auto& [link, point] = std::ranges::min(ways, {}, distance);
  route(facet, link, point);
}

/// With the facet's number in place of the coordinate that the projection forgets, so that only links of one facet
/// meet.
Box3 CrossingResolver::box_of_link(const OutlineLink& link) const {
  const Projection plane = outlines_.facets().projection(link.facet);
  const std::size_t across = 3 - first_axis(plane) - second_axis(plane);
  const auto [from, to] = chains_.ends(link.link);
  const PointTable& table = outlines_.points().table;
  Box3 box = unite(box_of(table[from.index()]), box_of(table[to.index()]));
  box.min[across] = box.max[across] = link.facet.index();
  return box;
}

void CrossingResolver::run(const std::vector<OutlineLink>& links, const Monitor& monitor) {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  entries.reserve(links.size());
  for (std::uint32_t i = 0; i < links.size(); ++i) entries.push_back({box_of_link(links[i]), i});
  rtree::for_each_pair(rtree::RTree<std::uint32_t>::bulk_load(entries), [&](std::uint32_t i, std::uint32_t j) {
    if (monitor.is_cancelled()) return;
    const ChainLink &a = links[i].link, &b = links[j].link;
    const bool is_same_link = a.chain == b.chain && a.index == b.index;
    if (links[i].facet == links[j].facet && !is_same_link) resolve(links[i].facet, a, b);
  });
}

}  // namespace

std::vector<CoplanarFacetId> resolve_crossings(FacetOutlines& outlines, const std::vector<OutlineLink>& links,
                                               const Monitor& monitor) {
  CrossingResolver resolver(outlines);
  resolver.run(links, monitor);
  return std::move(resolver).given_up();
}

}  // namespace algebra3d
