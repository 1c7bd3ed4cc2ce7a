#include "algebra3d/kernel/rounding/detail/facet_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/circulators.h"
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

/// Notes that chains are to be routed through points which they may have passed over when their ends moved: corners of
/// a facet along the chain that are no farther from it than the chain and the corner together may have moved. Requires
/// straight chains. If `monitor` is cancelled, some are left out. Cost: n log n.
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

/// Routes the first link through an end of the other that lies on it. False without such an end.
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

/// For every two links of one outline that cross or touch: notes that one of them is to be routed through the nearest
/// end of the other. Returns the facets of which a link would have to lead too far aside: their outlines are to be
/// given up. If `monitor` is cancelled, some are left out. Cost: n log n in the links.
std::vector<CoplanarFacetId> resolve_crossings(FacetOutlines& outlines, const std::vector<OutlineLink>& links,
                                               const Monitor& monitor) {
  CrossingResolver resolver(outlines);
  resolver.run(links, monitor);
  return std::move(resolver).given_up();
}

/// Edges that still cross after so many rounds are left to those who divide the mesh at itself.
constexpr int kMaxRounds = 4;
/// An outline that gets more links than so many times its first ones is given up, too.
constexpr std::size_t kMostLinks = 3;

/// An edge of a facet between moved points, from the lower to the higher one.
struct EdgeOfFacet {
  PointId from, to;
  CoplanarFacetId facet;
  bool is_reversed;
};

}  // namespace

FacetOutlines::FacetOutlines(const TriangleMesh& mesh, const MovedVertices& moved, const Monitor& monitor)
    : mesh_(mesh), facets_(mesh), points_(moved), chains_(points_.points) {
  note_movements(moved);
  find_outline_chains();
  if (monitor.is_cancelled()) return;
  route_through_passed_points(*this, monitor);
  apply_routes();
  for (const CoplanarFacetId facet : facets_.ids()) first_link_counts_.push_back(link_count(facet));
  route_around_crossings(monitor);
}

std::span<const OutlineChain> FacetOutlines::outline_chains(CoplanarFacetId facet) const {
  const std::size_t first = first_side_[facet], last = first_side_[CoplanarFacetId(facet.index() + 1)];
  return std::span(outline_chains_).subspan(first, last - first);
}

IndexTriangle FacetOutlines::triangle(FaceId face) const {
  IndexTriangle corners = mesh_.triangle(face);
  for (std::uint32_t& corner : corners) corner = points_.of(VertexId(corner)).index();
  return corners;
}

std::size_t FacetOutlines::link_count(CoplanarFacetId facet) const {
  std::size_t count = 0;
  for (const OutlineChain& side : outline_chains(facet)) count += chains_.link_count(side.chain);
  return count;
}

void FacetOutlines::note_movements(const MovedVertices& moved) {
  is_moved_.resize(facets_.ids().size());
  is_given_up_.resize(facets_.ids().size());
  for (const FaceId face : faces(mesh_))
    for (const std::uint32_t vertex : mesh_.triangle(face))
      if (moved.movements[vertex] > 0) is_moved_[facets_.of(face)] = true;
  to_check_ = is_moved_;
}

/// Makes one chain for all edges between the same two points.
void FacetOutlines::find_outline_chains() {
  std::vector<EdgeOfFacet> edges;
  for (const HalfedgeId h : halfedges(mesh_)) {
    const PointId from = points_.of(mesh_.origin(h)), to = points_.of(mesh_.target(h));
    if (from != to && facets_.is_boundary(h))
      edges.push_back({std::min(from, to), std::max(from, to), facets_.of(TriangleMesh::face(h)), from > to});
  }
  std::ranges::sort(edges, {}, [](const EdgeOfFacet& e) { return std::tuple(e.from, e.to, e.facet, e.is_reversed); });
  ChainId chain;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool is_new = i == 0 || edges[i].from != edges[i - 1].from || edges[i].to != edges[i - 1].to;
    if (is_new) chain = chains_.add(edges[i].from, edges[i].to);
    outline_chains_.push_back({edges[i].facet, chain, edges[i].is_reversed});
  }
  std::ranges::stable_sort(outline_chains_, {}, &OutlineChain::facet);
  for (std::size_t facet = 0; facet <= facets_.ids().size(); ++facet)
    first_side_.push_back(static_cast<std::size_t>(
        std::ranges::lower_bound(outline_chains_, CoplanarFacetId(facet), {}, &OutlineChain::facet) -
        outline_chains_.begin()));
}

bool FacetOutlines::apply_routes() {
  const std::vector<ChainId> changed = chains_.apply();
  for (const OutlineChain& side : outline_chains_)
    if (std::ranges::binary_search(changed, side.chain)) is_moved_[side.facet] = to_check_[side.facet] = true;
  return !changed.empty();
}

std::vector<OutlineLink> FacetOutlines::links_to_check() {
  std::vector<OutlineLink> links;
  for (const CoplanarFacetId facet : facets_.ids()) {
    if (is_given_up_[facet] || !to_check_[facet]) continue;
    is_given_up_[facet] = link_count(facet) > kMostLinks * first_link_counts_[facet];
    if (is_given_up_[facet]) continue;
    for (const OutlineChain& side : outline_chains(facet))
      for (std::uint32_t index = 0; index < chains_.link_count(side.chain); ++index)
        links.push_back({facet, {side.chain, index}});
  }
  to_check_.assign(facets_.ids().size(), false);
  return links;
}

void FacetOutlines::route_around_crossings(const Monitor& monitor) {
  for (int round = 0; round < kMaxRounds && !monitor.is_cancelled(); ++round) {
    for (const CoplanarFacetId facet : resolve_crossings(*this, links_to_check(), monitor)) is_given_up_[facet] = true;
    if (!apply_routes()) return;
  }
}

/// Adds the links of a chain, in the direction of the outline.
void FacetOutlines::add_links(const OutlineChain& side, std::vector<DirectedEdge>& links) const {
  for (std::uint32_t index = 0; index < chains_.link_count(side.chain); ++index) {
    const auto [from, to] = chains_.ends({side.chain, index});
    links.push_back(side.is_reversed ? DirectedEdge(to.index(), from.index()) : DirectedEdge(from.index(), to.index()));
  }
}

// A pair of opposite links of two chains bounds nothing; that of one chain, with the facet on both sides, is an edge at
// which other facets end.
FacetOutline FacetOutlines::outline(CoplanarFacetId facet) const {
  const auto sides = outline_chains(facet);  // those of one chain are neighbours
  std::vector<DirectedEdge> links, slits;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_slit = i + 1 < sides.size() && sides[i].chain == sides[i + 1].chain &&
                         sides[i].is_reversed != sides[i + 1].is_reversed;
    add_links(sides[i], is_slit ? slits : links);
    if (is_slit) ++i;
  }
  FacetOutline outline{without_opposites(std::move(links)), {}};
  if (slits.empty()) return outline;
  std::set<DirectedEdge> listed;
  for (const auto& [from, to] : outline.boundary) listed.insert(std::minmax(from, to));
  for (const auto& [from, to] : slits)
    if (listed.insert(std::minmax(from, to)).second)
      outline.slits.insert(outline.slits.end(), {{from, to}, {to, from}});
  return outline;
}

void FacetOutline::reverse() {
  for (auto& [from, to] : boundary) std::swap(from, to);
  boundary = without_opposites(std::move(boundary));
}

std::vector<DirectedEdge> without_opposites(std::vector<DirectedEdge> edges) {
  const auto key = [](const DirectedEdge& e) { return std::pair(std::minmax(e.first, e.second), e); };
  std::ranges::sort(edges, [&](const DirectedEdge& a, const DirectedEdge& b) { return key(a) < key(b); });
  std::vector<DirectedEdge> result;
  for (const DirectedEdge& edge : edges) {
    if (!result.empty() && result.back() == DirectedEdge(edge.second, edge.first))
      result.pop_back();
    else
      result.push_back(edge);
  }
  return result;
}

}  // namespace algebra3d
