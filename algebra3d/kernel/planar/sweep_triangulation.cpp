#include "algebra3d/kernel/planar/sweep_triangulation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory_resource>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"
#include "base/id_vector.h"

namespace algebra3d {
namespace {

/// A vertex, in the order in which the sweep meets them: one with a lower id is earlier.
using SweepVertexId = StrongId<struct SweepVertexTag>;
/// An edge, in the order in which they are given.
using SweepEdgeId = StrongId<struct SweepEdgeTag>;
/// A link of a frontier.
using LinkId = StrongId<struct LinkTag>;

/// An edge as the sweep meets it, from the earlier end to the later one.
struct SweepEdge {
  SweepVertexId earlier, later;
  bool has_inside_above;
};

class Sweep {
 public:
  Sweep(const PointTable& points, Projection projection, std::vector<IndexTriangle>& triangles)
      : points_(points), projection_(projection), triangles_(triangles), active_(Below{this}, &memory_) {}

  /// False, and some triangles, if the edges bound no region.
  bool run(std::span<const DirectedEdge> edges);

 private:
  /// The frontier within one gap between neighbouring active edges: the vertices from the one below to the one above
  /// that are seen from later ones. It turns left at each vertex, or goes straight on.
  struct Link {
    SweepVertexId vertex;
    LinkId below = {}, above = {};
  };
  struct Frontier {
    LinkId bottom = {}, top = {}, latest = {};  // latest: that of the latest vertex
  };
  template <typename Id, typename T>
  using Numbered = IdVector<Id, T, std::pmr::polymorphic_allocator<T>>;

  struct Below {
    using is_transparent = void;
    const Sweep* sweep;
    bool operator()(SweepEdgeId a, SweepEdgeId b) const { return sweep->is_below(a, b); }
    /// An edge that ends in the vertex is not below it.
    bool operator()(SweepEdgeId edge, SweepVertexId vertex) const { return sweep->is_below(edge, vertex); }
  };
  using Active = std::pmr::set<SweepEdgeId, Below>;

  void collect(std::span<const DirectedEdge> edges);

  PointRef point(SweepVertexId vertex) const { return points_[numbers_[vertex]]; }
  int turn(SweepVertexId a, SweepVertexId b, SweepVertexId c) const {
    return orient2d(projection_, point(a), point(b), point(c));
  }
  bool is_below(SweepEdgeId a, SweepEdgeId b) const;
  bool is_below(SweepEdgeId edge, SweepVertexId vertex) const {
    return edges_[edge].later != vertex && side(edge, vertex) > 0;
  }
  int side(SweepEdgeId edge, SweepVertexId vertex) const;

  bool visit(SweepVertexId vertex, std::span<const SweepEdgeId> starting);
  bool alternate(std::span<const SweepEdgeId> edges, bool inside_below, bool inside_above) const;

  LinkId new_link(SweepVertexId vertex);
  void add_on_top(Frontier& frontier, SweepVertexId vertex);
  void add_at_bottom(Frontier& frontier, SweepVertexId vertex);
  void close(const Frontier& frontier, SweepVertexId vertex);
  std::pair<Frontier, Frontier> split(const Frontier& frontier, SweepVertexId vertex);
  Frontier join(const Frontier& lower, const Frontier& upper);
  void emit(SweepVertexId a, SweepVertexId b, SweepVertexId c) {
    triangles_.push_back({numbers_[a], numbers_[b], numbers_[c]});
  }

  const PointTable& points_;
  Projection projection_;
  std::vector<IndexTriangle>& triangles_;
  // Most regions have few edges: enough for these.
  std::array<std::byte, 4096> buffer_;
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
  Numbered<SweepVertexId, std::uint32_t> numbers_{&memory_};  // of the points of vertices
  Numbered<SweepEdgeId, SweepEdge> edges_{&memory_};
  Numbered<SweepEdgeId, Frontier> frontiers_{&memory_};  // of each edge with the inside above it, while it is active
  Numbered<LinkId, Link> links_{&memory_};
  Active active_;  // from below to above
};

/// 1 for a vertex above the edge, -1 below it. One that lies inside of it is on the outer side: chains that end there
/// touch the region of the edge from outside.
int Sweep::side(SweepEdgeId edge, SweepVertexId vertex) const {
  const SweepEdge& e = edges_[edge];
  if (const int found = turn(e.earlier, e.later, vertex); found != 0) return found;
  return e.has_inside_above ? -1 : 1;
}

bool Sweep::is_below(SweepEdgeId a, SweepEdgeId b) const {
  const SweepEdge &e = edges_[a], &f = edges_[b];
  if (e.earlier == f.earlier) {
    if (e.later == f.later) return !e.has_inside_above && f.has_inside_above;
    return turn(e.earlier, e.later, f.later) > 0;
  }
  if (e.earlier < f.earlier) return side(a, f.earlier) > 0;
  return side(b, e.earlier) < 0;
}

LinkId Sweep::new_link(SweepVertexId vertex) {
  return links_.push_back({vertex});
}

void Sweep::add_on_top(Frontier& frontier, SweepVertexId vertex) {
  LinkId top = frontier.top;
  while (top != frontier.bottom) {
    const LinkId second = links_[top].below;
    if (turn(links_[second].vertex, links_[top].vertex, vertex) >= 0) break;
    emit(links_[top].vertex, links_[second].vertex, vertex);
    top = second;
  }
  const LinkId added = new_link(vertex);
  links_[added].below = top;
  links_[top].above = added;
  frontier.top = frontier.latest = added;
}

void Sweep::add_at_bottom(Frontier& frontier, SweepVertexId vertex) {
  LinkId bottom = frontier.bottom;
  while (bottom != frontier.top) {
    const LinkId second = links_[bottom].above;
    if (turn(vertex, links_[bottom].vertex, links_[second].vertex) >= 0) break;
    emit(vertex, links_[second].vertex, links_[bottom].vertex);
    bottom = second;
  }
  const LinkId added = new_link(vertex);
  links_[added].above = bottom;
  links_[bottom].below = added;
  frontier.bottom = frontier.latest = added;
}

void Sweep::close(const Frontier& frontier, SweepVertexId vertex) {
  for (LinkId link = frontier.bottom; link != frontier.top; link = links_[link].above)
    emit(links_[link].vertex, vertex, links_[links_[link].above].vertex);
}

/// Connects the vertex with the latest one before it, which it sees, and parts the frontier there.
std::pair<Sweep::Frontier, Sweep::Frontier> Sweep::split(const Frontier& frontier, SweepVertexId vertex) {
  const LinkId middle = frontier.latest;
  const LinkId copy = new_link(links_[middle].vertex);
  links_[copy].above = links_[middle].above;
  if (middle != frontier.top) links_[links_[middle].above].below = copy;
  Frontier lower{frontier.bottom, middle, middle};
  Frontier upper{copy, middle == frontier.top ? copy : frontier.top, copy};
  add_on_top(lower, vertex);
  add_at_bottom(upper, vertex);
  return {lower, upper};
}

/// Both end in the same vertex, the latest.
Sweep::Frontier Sweep::join(const Frontier& lower, const Frontier& upper) {
  if (upper.bottom == upper.top) return lower;
  links_[lower.top].above = links_[upper.bottom].above;
  links_[links_[upper.bottom].above].below = lower.top;
  return {lower.bottom, upper.top, lower.top};
}

/// True if the inside ends at the next edge above it, and begins at one in the outside.
bool Sweep::alternate(std::span<const SweepEdgeId> edges, bool inside_below, bool inside_above) const {
  for (const SweepEdgeId edge : edges)
    if (std::exchange(inside_below, edges_[edge].has_inside_above) == inside_below) return false;
  return inside_below == inside_above;
}

/// False if the edges that start in the vertex do not fit there.
bool Sweep::visit(SweepVertexId vertex, std::span<const SweepEdgeId> starting) {
  auto at = active_.lower_bound(vertex);
  const bool inside_below = at != active_.begin() && edges_[*std::prev(at)].has_inside_above;
  const auto under = at == active_.begin() ? active_.end() : std::prev(at);
  Frontier lower, upper;  // of the gaps below and above the vertex, where they are inside
  bool inside_above = inside_below;
  if (inside_below) lower = frontiers_[*under];
  if (at != active_.end() && edges_[*at].later == vertex) {
    if (inside_below) add_on_top(lower, vertex);
    while (at != active_.end() && edges_[*at].later == vertex) {
      inside_above = edges_[*at].has_inside_above;
      const bool is_last = std::next(at) == active_.end() || edges_[*std::next(at)].later != vertex;
      if (inside_above && is_last) {
        upper = frontiers_[*at];
        add_at_bottom(upper, vertex);
      } else if (inside_above) {
        close(frontiers_[*at], vertex);
      }
      at = active_.erase(at);
    }
    if (starting.empty() && inside_below) lower = join(lower, upper);
  } else if (inside_below) {
    std::tie(lower, upper) = split(lower, vertex);
  }
  if (!alternate(starting, inside_below, inside_above)) return false;
  if (inside_below) frontiers_[*under] = lower;
  for (std::size_t i = 0; i < starting.size(); ++i) {
    active_.insert(at, starting[i]);
    if (!edges_[starting[i]].has_inside_above) continue;
    if (i + 1 == starting.size()) {
      frontiers_[starting[i]] = upper;
    } else {
      const LinkId link = new_link(vertex);
      frontiers_[starting[i]] = {link, link, link};
    }
  }
  return true;
}

/// Numbers the vertices in the order of the sweep, by their first and then their second coordinates, and adds the
/// edges.
void Sweep::collect(std::span<const DirectedEdge> edges) {
  std::pmr::vector<std::uint32_t> points(&memory_);  // ascending, each once
  points.reserve(2 * edges.size());
  for (const auto& [from, to] : edges) {
    points.push_back(from);
    points.push_back(to);
  }
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::pmr::vector<std::uint32_t> places(points.size(), &memory_);  // in `points`, by vertices
  std::iota(places.begin(), places.end(), 0U);
  std::ranges::sort(places, [&](std::uint32_t a, std::uint32_t b) {
    const PointRef p = points_[points[a]], q = points_[points[b]];
    auto order = compare(first_axis(projection_), p, q);
    if (std::is_eq(order)) order = compare(second_axis(projection_), p, q);
    return std::is_lt(order);
  });
  std::pmr::vector<SweepVertexId> vertices(points.size(), &memory_);  // parallel to `points`
  numbers_.reserve(points.size());
  for (const std::uint32_t place : places) vertices[place] = numbers_.push_back(points[place]);

  const auto vertex_of = [&](std::uint32_t point) {
    return vertices[static_cast<std::size_t>(std::ranges::lower_bound(points, point) - points.begin())];
  };
  edges_.reserve(edges.size());
  for (const auto& [from_point, to_point] : edges) {
    const SweepVertexId from = vertex_of(from_point), to = vertex_of(to_point);
    edges_.push_back(from < to ? SweepEdge{from, to, true} : SweepEdge{to, from, false});
  }
}

bool Sweep::run(std::span<const DirectedEdge> edges) {
  collect(edges);
  links_.reserve(2 * edges.size());
  frontiers_.resize(edges_.size());
  std::pmr::vector<SweepEdgeId> order(&memory_);
  order.reserve(edges_.size());
  for (const SweepEdgeId edge : edges_.ids()) order.push_back(edge);
  std::ranges::sort(order, [&](SweepEdgeId a, SweepEdgeId b) {
    if (edges_[a].earlier != edges_[b].earlier) return edges_[a].earlier < edges_[b].earlier;
    return is_below(a, b);
  });
  auto next = order.begin();
  for (const SweepVertexId vertex : numbers_.ids()) {
    const auto first = next;
    while (next != order.end() && edges_[*next].earlier == vertex) ++next;
    if (!visit(vertex, std::span(first, next))) return false;
  }
  return true;
}

/// The corners, the one with the lowest number first, if the edges are those of one triangle: most regions are.
std::optional<IndexTriangle> single_triangle(std::span<const DirectedEdge> edges) {
  if (edges.size() != 3) return std::nullopt;
  const DirectedEdge& first = *std::ranges::min_element(edges);
  const auto after = [&](const DirectedEdge& edge) {
    return std::ranges::find(edges, edge.second, &DirectedEdge::first);
  };
  const auto second = after(first);
  if (second == edges.end()) return std::nullopt;
  const auto third = after(*second);
  if (third == edges.end() || third->second != first.first || third->first == first.first) return std::nullopt;
  return IndexTriangle{first.first, second->first, third->first};
}

}  // namespace

bool triangulate_by_sweep(const PointTable& points, Projection projection, std::span<const DirectedEdge> edges,
                          std::vector<IndexTriangle>& triangles) {
  if (const auto triangle = single_triangle(edges)) {
    const auto& [a, b, c] = *triangle;
    triangles.push_back(*triangle);
    return orient2d(projection, points[a], points[b], points[c]) > 0;
  }
  return Sweep(points, projection, triangles).run(edges);
}

}  // namespace algebra3d
