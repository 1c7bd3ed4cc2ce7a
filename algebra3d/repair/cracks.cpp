#include "algebra3d/repair/cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/disjoint_sets.h"
#include "algebra3d/exact/predicates.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

using Tree = rtree::RTree<std::uint32_t>;

double distance(const Vec3& a, const Vec3& b) {
  return length(a - b);
}

Box3 widened(Box3 box, double by) {
  box.min = box.min - Vec3{by, by, by};
  box.max = box.max + Vec3{by, by, by};
  return box;
}

bool is_exactly_on(const Vec3& from, const Vec3& p, const Vec3& to) {
  return collinear(from, p, to) && compare(from, p) == compare(p, to);
}

/// Edges that one facet has.
struct Boundary {
  struct Edge {
    std::uint32_t from, to;
    std::uint32_t triangle, corner;  // runs from this corner of the triangle to the next
  };
  std::vector<Edge> edges;
  std::vector<std::uint32_t> vertices;  // ascending

  explicit Boundary(const FacetList& facets) {
    const auto linked = facets.mesh();
    const TriangleMesh& mesh = *linked;
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      const HalfedgeId halfedge(h);
      if (!mesh.is_boundary(halfedge)) continue;
      edges.push_back({mesh.origin(halfedge).index(), mesh.target(halfedge).index(), h / 3, h % 3});
      vertices.push_back(edges.back().from);
      vertices.push_back(edges.back().to);
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
};

/// A vertex in the middle of an edge.
struct Division {
  std::uint32_t triangle, corner;
  double parameter;  // ascending from the edge's start to its end
  std::uint32_t vertex;

  friend auto operator<=>(const Division&, const Division&) = default;
};

/// The triangle in pieces, whose edge from `corner` on passes through the vertices.
void divide(FacetList& facets, std::uint32_t triangle, std::uint32_t corner, std::span<const Division> at) {
  const TriangleMesh::Triangle whole = facets.triangles[triangle];
  const std::uint32_t end = whole[(corner + 1) % 3], apex = whole[(corner + 2) % 3];
  // The first piece keeps the place, and with it the edge at its corner.
  facets.triangles[triangle][(corner + 1) % 3] = at.front().vertex;
  for (std::size_t i = 0; i < at.size(); ++i)
    facets.triangles.push_back({at[i].vertex, i + 1 < at.size() ? at[i + 1].vertex : end, apex});
  facets.changed();
}

void report_divisions(const FacetList& facets, std::span<const Division> divisions, RepairReport& report) {
  const Division& first = divisions.front();
  const Vec3 &from = facets.corner(first.triangle, first.corner),
             &to = facets.corner(first.triangle, (first.corner + 1) % 3);
  for (const Division& d : divisions) {
    const Vec3& vertex = facets.points[d.vertex];
    const bool is_on_edge = is_exactly_on(from, vertex, to);
    report.add(RepairStep::divided_edges, vertex, is_on_edge ? 0 : distance(vertex, from + d.parameter * (to - from)));
  }
}

/// Of a triangle one edge at a time, for the pieces have other edges; false if some were left for that reason.
bool divide_once(FacetList& facets, std::vector<Division> divisions, RepairReport& report) {
  std::ranges::sort(divisions);
  std::uint32_t last_triangle = std::numeric_limits<std::uint32_t>::max();
  bool is_all = true;
  for (std::size_t begin = 0, end = 0; begin < divisions.size(); begin = end) {
    const auto edge = [](const Division& d) { return std::pair(d.triangle, d.corner); };
    while (end < divisions.size() && edge(divisions[end]) == edge(divisions[begin])) ++end;
    if (divisions[begin].triangle == last_triangle) {
      is_all = false;
      continue;
    }
    last_triangle = divisions[begin].triangle;
    report_divisions(facets, std::span(divisions).subspan(begin, end - begin), report);
    divide(facets, divisions[begin].triangle, divisions[begin].corner,
           std::span(divisions).subspan(begin, end - begin));
  }
  return is_all;
}

/// Finds, for each boundary edge, boundary vertices near it.
template <typename IsOnEdge>
std::vector<Division> find_divisions(const FacetList& facets, double reach, IsOnEdge is_on_edge) {
  const Boundary boundary(facets);
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const std::uint32_t v : boundary.vertices) entries.push_back({Box3::of(facets.points[v]), v});
  const Tree tree = Tree::bulk_load(entries);
  std::vector<Division> result;
  for (const Boundary::Edge& edge : boundary.edges) {
    const Vec3 &from = facets.points[edge.from], &to = facets.points[edge.to];
    Box3 box = Box3::of(from);
    box.extend(to);
    const TriangleMesh::Triangle& triangle = facets.triangles[edge.triangle];
    for (const std::uint32_t v : tree.window(widened(box, reach))) {
      if (std::ranges::find(triangle, v) != triangle.end() || !is_on_edge(from, facets.points[v], to)) continue;
      const Vec3 along = to - from;
      result.push_back({edge.triangle, edge.corner, dot(facets.points[v] - from, along) / dot(along, along), v});
    }
  }
  return result;
}

/// Joins of vertices, each to the lowest one of its set.
class Joins {
 public:
  Joins(const FacetList& facets, const Boundary& boundary, double tolerance)
      : facets_(facets), tolerance_(tolerance), sets_(facets.points.size()), reach_(facets.points.size(), tolerance) {
    for (const Boundary::Edge& edge : boundary.edges) {
      const double third = distance(facets.points[edge.from], facets.points[edge.to]) / 3;
      reach_[edge.from] = std::min(reach_[edge.from], third);
      reach_[edge.to] = std::min(reach_[edge.to], third);
    }
  }

  /// To be called before anything is joined.
  void find_neighbours(const Boundary& boundary) {
    for (const TriangleMesh::Triangle& triangle : facets_.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        if (std::ranges::binary_search(boundary.vertices, triangle[i]))
          for (std::size_t k = 1; k < 3; ++k) neighbours_[triangle[i]].push_back(triangle[(i + k) % 3]);
  }

  double reach(std::uint32_t vertex) const { return reach_[vertex]; }
  std::uint32_t find(std::uint32_t vertex) { return sets_.find(vertex); }
  void join(std::uint32_t a, std::uint32_t b);

 private:
  bool share_a_facet(std::uint32_t a, std::uint32_t b);
  std::vector<std::uint32_t>& members(std::uint32_t set) {
    auto& list = members_[set];
    if (list.empty()) list.push_back(set);
    return list;
  }

  const FacetList& facets_;
  double tolerance_;
  arrangement::DisjointSets sets_;
  std::vector<double> reach_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours_, members_;
};

/// True if a facet has corners in both sets.
bool Joins::share_a_facet(std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t member : members(a))
    for (const std::uint32_t neighbour : neighbours_[member])
      if (sets_.find(neighbour) == b) return true;
  return false;
}

void Joins::join(std::uint32_t a, std::uint32_t b) {
  a = sets_.find(a);
  b = sets_.find(b);
  if (a == b) return;
  if (a > b) std::swap(a, b);
  for (const std::uint32_t member : members(b))
    if (distance(facets_.points[member], facets_.points[a]) > tolerance_) return;
  if (share_a_facet(a, b)) return;
  sets_.unite(a, b);
  auto& joined = members(a);
  joined.insert(joined.end(), members_[b].begin(), members_[b].end());
  members_.erase(b);
}

struct NearPair {
  double distance;
  std::uint32_t a, b;

  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

void join_vertices(FacetList& facets, double tolerance, RepairReport& report) {
  const Boundary boundary(facets);
  Joins joins(facets, boundary, tolerance);
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const std::uint32_t v : boundary.vertices) entries.push_back({Box3::of(facets.points[v]), v});
  const Tree tree = Tree::bulk_load(entries);
  std::vector<NearPair> pairs;
  for (const std::uint32_t a : boundary.vertices)
    for (const std::uint32_t b : tree.window(widened(Box3::of(facets.points[a]), joins.reach(a)))) {
      const double apart = distance(facets.points[a], facets.points[b]);
      if (a < b && apart <= std::min(joins.reach(a), joins.reach(b))) pairs.push_back({apart, a, b});
    }
  if (pairs.empty()) return;
  std::ranges::sort(pairs);
  joins.find_neighbours(boundary);
  for (const NearPair& pair : pairs) joins.join(pair.a, pair.b);
  bool has_joined = false;
  for (const std::uint32_t v : boundary.vertices) {
    const std::uint32_t to = joins.find(v);
    if (to == v) continue;
    has_joined = true;
    report.add(RepairStep::cracks, facets.points[v], distance(facets.points[v], facets.points[to]));
  }
  if (!has_joined) return;
  for (TriangleMesh::Triangle& triangle : facets.triangles)
    for (std::uint32_t& corner : triangle) corner = joins.find(corner);
  facets.changed();
}

/// The divisions without those of edges of which some piece does not meet exactly one other boundary edge, or piece of
/// one, that runs the other way: dividing them would close nothing, and cut up the rims of holes that are as thin as
/// cracks.
std::vector<Division> that_close(const FacetList& facets, std::vector<Division> divisions) {
  using Piece = std::pair<std::uint32_t, std::uint32_t>;
  const Boundary boundary(facets);
  std::ranges::sort(divisions);
  const auto edge_of = [](const auto& place) { return std::pair(place.triangle, place.corner); };
  std::vector<std::pair<Boundary::Edge, std::vector<std::uint32_t>>> edges;  // with the vertices on them
  for (const Boundary::Edge& edge : boundary.edges) {
    edges.emplace_back(edge, std::vector<std::uint32_t>());
    const auto first = std::ranges::lower_bound(divisions, edge_of(edge), {}, edge_of);
    const auto last = std::ranges::upper_bound(divisions, edge_of(edge), {}, edge_of);
    for (auto d = first; d != last; ++d) edges.back().second.push_back(d->vertex);
  }
  const auto for_each_piece = [](const auto& edge, auto visit) {
    std::uint32_t from = edge.first.from;
    for (const std::uint32_t vertex : edge.second) visit(Piece(std::exchange(from, vertex), vertex));
    visit(Piece(from, edge.first.to));
  };
  for (bool has_changed = true; std::exchange(has_changed, false);) {
    std::vector<Piece> pieces;
    for (const auto& edge : edges) for_each_piece(edge, [&](Piece piece) { pieces.push_back(piece); });
    std::ranges::sort(pieces);
    const auto count = [&](Piece piece) {
      return std::ranges::upper_bound(pieces, piece) - std::ranges::lower_bound(pieces, piece);
    };
    for (auto& edge : edges) {
      if (edge.second.empty()) continue;
      bool closes = true;
      for_each_piece(edge, [&](Piece piece) {
        closes = closes && count(piece) == 1 && count({piece.second, piece.first}) == 1;
      });
      if (closes) continue;
      edge.second.clear();
      has_changed = true;
    }
  }
  // The boundary edges are in the order of their triangles.
  std::erase_if(divisions, [&](const Division& division) {
    return std::ranges::lower_bound(edges, edge_of(division), {}, [&](const auto& e) { return edge_of(e.first); })
        ->second.empty();
  });
  return divisions;
}

}  // namespace

void divide_edges(FacetList& facets, RepairReport& report) {
  while (!divide_once(facets, find_divisions(facets, 0, is_exactly_on), report)) {
  }
}

void join_equal_corners(FacetList& facets, double noise, RepairReport& report) {
  if (noise > 0) join_vertices(facets, noise, report);
}

void close_cracks(FacetList& facets, double tolerance, RepairReport& report) {
  join_vertices(facets, tolerance, report);
  const auto is_near = [&](const Vec3& from, const Vec3& p, const Vec3& to) {
    const Vec3 along = to - from;
    const double parameter = dot(p - from, along) / dot(along, along);
    const double reach = std::min(tolerance, std::sqrt(dot(along, along)) / 3);
    if (!(parameter > 0 && parameter < 1)) return false;
    return distance(p, from + parameter * along) <= reach && std::min(distance(p, from), distance(p, to)) > reach;
  };
  divide_once(facets, that_close(facets, find_divisions(facets, tolerance, is_near)), report);
}

}  // namespace algebra3d
