#include "algebra3d/repair/facet_outlines.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "algebra3d/halfedge/boxes.h"
#include "rtree/rtree.h"

namespace algebra3d {

using arrangement::DirectedEdge;

namespace {

/// Edges that still cross after so many rounds are left to who divides the mesh at itself.
constexpr int kMaxRounds = 4;
/// The outline of a facet that gets more links than so many times those at first is left, too.
constexpr std::size_t kMostLinks = 3;
/// No edge is led farther aside, to avoid a crossing, than by so many times the largest movement of a vertex.
constexpr double kFarthestDetour = 2;

Box3 grown(Box3 box, double by) {
  box.min = box.min - Vec3{by, by, by};
  box.max = box.max + Vec3{by, by, by};
  return box;
}

}  // namespace

MovedPoints::MovedPoints(const MovedVertices& moved) {
  numbers.reserve(moved.points.size());
  for (std::size_t v = 0; v < moved.points.size(); ++v) {
    const std::uint32_t number = pool.intern(moved.points[v]);
    numbers.push_back(number);
    if (number == points.size()) {
      points.push_back(moved.points[v].approx);
      movements.push_back(0);
    }
    movements[number] = std::max(movements[number], moved.movements[v]);
    largest_movement = std::max(largest_movement, moved.movements[v]);
  }
}

FacetOutlines::FacetOutlines(const TriangleMesh& mesh, const MovedVertices& moved)
    : mesh_(mesh), facets_(mesh), points_(moved), edges_(points_.points) {
  find_facets(moved);
  find_edges();
  lead_through_passed_vertices();
  for (std::uint32_t facet = 0; facet < facets_.count(); ++facet) first_link_counts_.push_back(link_count(facet));
  int round = 0;
  while (round < kMaxRounds && lead_around_crossings()) ++round;
}

TriangleMesh::Triangle FacetOutlines::triangle(std::uint32_t face) const {
  TriangleMesh::Triangle corners = mesh_.triangle(FaceId(face));
  for (std::uint32_t& corner : corners) corner = points_.numbers[corner];
  return corners;
}

std::size_t FacetOutlines::link_count(std::uint32_t facet) const {
  std::size_t count = 0;
  for (const BoundaryEdge& side : boundary(facet)) count += edges_[side.edge].size() - 1;
  return count;
}

void FacetOutlines::find_facets(const MovedVertices& moved) {
  is_moved_.resize(facets_.count());
  is_tangled_.resize(facets_.count());
  for (std::uint32_t face = 0; face < facets_.face_count(); ++face)
    for (const std::uint32_t vertex : mesh_.triangle(FaceId(face)))
      if (moved.movements[vertex] > 0) is_moved_[facets_->of_face(face)] = true;
  to_check_ = is_moved_;
}

/// Edges that lie upon each other now are one.
void FacetOutlines::find_edges() {
  struct Side {
    std::uint32_t from, to, facet;
    bool is_reversed;
  };
  std::vector<Side> sides;
  for (std::uint32_t face = 0; face < facets_.face_count(); ++face) {
    const auto corners = triangle(face);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
      if (from != to && facets_->is_boundary(3 * face + i))
        sides.push_back({std::min(from, to), std::max(from, to), facets_->of_face(face), from > to});
    }
  }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.from, s.to, s.facet, s.is_reversed); });
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_new = i == 0 || sides[i].from != sides[i - 1].from || sides[i].to != sides[i - 1].to;
    if (is_new) edges_.add(sides[i].from, sides[i].to);
    boundary_.push_back({sides[i].facet, static_cast<std::uint32_t>(edges_.size() - 1), sides[i].is_reversed});
  }
  std::ranges::stable_sort(boundary_, {}, &BoundaryEdge::facet);
  for (std::uint32_t facet = 0; facet <= facets_.count(); ++facet)
    first_of_facet_.push_back(static_cast<std::uint32_t>(
        std::ranges::lower_bound(boundary_, facet, {}, &BoundaryEdge::facet) - boundary_.begin()));
}

/// The outlines of all facets along these edges, which ascend, have changed.
void FacetOutlines::touch_along(std::span<const std::uint32_t> edges) {
  for (const BoundaryEdge& side : boundary_)
    if (std::ranges::binary_search(edges, side.edge)) is_moved_[side.facet] = to_check_[side.facet] = true;
}

void FacetOutlines::lead_through_passed_vertices() {
  std::vector<double> movements(edges_.size());
  std::vector<bool> is_corner(points_.points.size());
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) {
    const auto [from, to] = edges_.ends({edge, 0});
    movements[edge] = std::max(points_.movements[from], points_.movements[to]);
    is_corner[from] = is_corner[to] = true;
    entries.push_back(
        {grown(unite(Box3::of(points_.points[from]), Box3::of(points_.points[to])), movements[edge]), edge});
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corners, sides;
  for (const BoundaryEdge& side : boundary_) {
    const auto [from, to] = edges_.ends({side.edge, 0});
    corners.emplace_back(from, side.facet);
    corners.emplace_back(to, side.facet);
    sides.emplace_back(side.edge, side.facet);
  }
  std::ranges::sort(corners);
  std::ranges::sort(sides);
  const auto have_common_facet = [&](std::uint32_t edge, std::uint32_t vertex) {
    for (auto s = std::ranges::lower_bound(sides, std::pair(edge, 0U)); s != sides.end() && s->first == edge; ++s)
      if (std::ranges::binary_search(corners, std::pair(vertex, s->second))) return true;
    return false;
  };
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
  for (std::uint32_t vertex = 0; vertex < points_.points.size(); ++vertex) {
    if (!is_corner[vertex]) continue;
    const double movement = points_.movements[vertex];
    for (const std::uint32_t edge : tree.window(grown(Box3::of(points_.points[vertex]), movement)))
      if (have_common_facet(edge, vertex) && movement + movements[edge] > 0 &&
          edges_.distance({edge, 0}, vertex) <= movement + movements[edge])
        edges_.lead_through({edge, 0}, vertex);
  }
  touch_along(edges_.apply());
}

/// Leads a link of the outline of a facet through a vertex, unless that is too far aside.
void FacetOutlines::lead(std::uint32_t facet, ChainLink link, std::uint32_t vertex) {
  const double detour = edges_.detour(link.edge) + edges_.distance(link, vertex);
  if (detour <= kFarthestDetour * points_.largest_movement)
    edges_.lead_through(link, vertex);
  else
    is_tangled_[facet] = true;
}

/// Leads the first link through an end of the other that lies on it. True if there is one.
bool FacetOutlines::lead_through_inner_end(std::uint32_t facet, ChainLink link, ChainLink crossing) {
  const auto [from, to] = edges_.ends(link);
  const auto lies_inside = [&, from = from, to = to](std::uint32_t end) {
    return end != from && end != to && turn(facets_.projection(facet), from, to, end) == 0 &&
           std::isfinite(edges_.distance(link, end));
  };
  const auto [a, b] = edges_.ends(crossing);
  if (!lies_inside(a) && !lies_inside(b)) return false;
  lead(facet, link, lies_inside(a) ? a : b);
  return true;
}

/// Where two links of the outline of a facet cross, the one is led through that end of the other that is nearest to it.
void FacetOutlines::resolve(std::uint32_t facet, ChainLink one, ChainLink other) {
  if (lead_through_inner_end(facet, one, other) || lead_through_inner_end(facet, other, one)) return;
  const auto [p, q] = edges_.ends(one);
  const auto [r, s] = edges_.ends(other);
  const auto parts = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    return turn(facets_.projection(facet), a, b, c) * turn(facets_.projection(facet), a, b, d) < 0;
  };
  if (!parts(p, q, r, s) || !parts(r, s, p, q)) return;
  const std::array<std::pair<ChainLink, std::uint32_t>, 4> ways{{{one, r}, {one, s}, {other, p}, {other, q}}};
  const auto distance = [&](const auto& way) { return edges_.distance(way.first, way.second); };
  const auto& [link, vertex] = std::ranges::min(ways, {}, distance);
  lead(facet, link, vertex);
}

/// True if edges were led through further vertices, so that new crossings are possible.
bool FacetOutlines::lead_around_crossings() {
  struct Link {
    const BoundaryEdge* side;
    std::uint32_t index;
  };
  std::vector<Link> links;
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (std::uint32_t facet = 0; facet < facets_.count(); ++facet) {
    if (is_tangled_[facet] || !to_check_[facet]) continue;
    if (link_count(facet) > kMostLinks * first_link_counts_[facet]) {
      is_tangled_[facet] = true;
      continue;
    }
    const std::size_t across = 3 - first_axis(facets_.projection(facet)) - second_axis(facets_.projection(facet));
    for (const BoundaryEdge& side : boundary(facet))
      for (std::uint32_t index = 0; index + 1 < edges_[side.edge].size(); ++index) {
        const auto [from, to] = edges_.ends({side.edge, index});
        Box3 box = unite(box_of(points_.pool[from]), box_of(points_.pool[to]));
        // In place of the coordinate that the projection forgets, so that only links of one facet meet.
        box.min[across] = box.max[across] = facet;
        entries.push_back({box, static_cast<std::uint32_t>(links.size())});
        links.push_back({&side, index});
      }
  }
  to_check_.assign(facets_.count(), false);
  rtree::for_each_pair(rtree::RTree<std::uint32_t>::bulk_load(entries), [&](std::uint32_t i, std::uint32_t j) {
    const BoundaryEdge &a = *links[i].side, &b = *links[j].side;
    if (a.facet == b.facet && !(a.edge == b.edge && links[i].index == links[j].index))
      resolve(a.facet, {a.edge, links[i].index}, {b.edge, links[j].index});
  });
  const std::vector<std::uint32_t> changed = edges_.apply();
  touch_along(changed);
  return !changed.empty();
}

/// The boundary of a facet as it is now.
std::vector<DirectedEdge> FacetOutlines::outline(std::uint32_t facet) const {
  std::vector<DirectedEdge> links;
  for (const BoundaryEdge& side : boundary(facet))
    for (std::uint32_t index = 0; index + 1 < edges_[side.edge].size(); ++index) {
      const auto [from, to] = edges_.ends({side.edge, index});
      links.push_back(side.is_reversed ? DirectedEdge(to, from) : DirectedEdge(from, to));
    }
  return without_opposites(std::move(links));
}

std::vector<DirectedEdge> without_opposites(std::vector<DirectedEdge> edges) {
  const auto place = [](const DirectedEdge& e) { return std::pair(std::minmax(e.first, e.second), e); };
  std::ranges::sort(edges, [&](const DirectedEdge& a, const DirectedEdge& b) { return place(a) < place(b); });
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
