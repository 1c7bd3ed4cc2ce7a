#include "algebra3d/kernel/rounding/detail/facet_outlines.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/rounding/detail/outline_crossings.h"
#include "algebra3d/kernel/rounding/detail/passed_points.h"

namespace algebra3d {
namespace {

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
