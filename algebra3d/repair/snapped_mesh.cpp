#include "algebra3d/repair/snapped_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "algebra3d/arrangement/triangulation.h"
#include "algebra3d/arrangement/vertex_pool.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/repair/edge_chains.h"
#include "algebra3d/repair/mesh_facets.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

using arrangement::DirectedEdge;
using arrangement::VertexPool;

/// Edges that still cross after so many rounds are left to who divides the mesh at itself.
constexpr int kMaxRounds = 4;
/// The outline of a facet that gets more links than so many times those at first is left, too.
constexpr std::size_t kMostLinks = 3;
/// No edge is led farther aside, to avoid a crossing, than by so many times the largest movement of a vertex.
constexpr double kFarthestDetour = 2;

/// Points by numbers that equal points share.
struct MovedPoints {
  explicit MovedPoints(const MovedVertices& moved);

  VertexPool pool;
  std::vector<Vec3> points;            // per number, rounded
  std::vector<double> movements;       // per number, the largest
  std::vector<std::uint32_t> numbers;  // per vertex
  double largest_movement = 0;
};

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

/// An edge as part of the boundary of a facet, which lies to its left.
struct BoundaryEdge {
  std::uint32_t facet, edge;
  bool is_reversed;  ///< runs from the end of the chain to its start
};

class Snapping {
 public:
  Snapping(const TriangleMesh& mesh, const MovedVertices& moved)
      : mesh_(mesh), facets_(mesh), points_(moved), edges_(points_.points) {
    find_facets(moved);
    find_edges();
  }

  SnappedMesh run();

 private:
  void find_facets(const MovedVertices& moved);
  void find_edges();
  void touch_along(std::span<const std::uint32_t> edges);
  void lead_through_passed_vertices();
  bool lead_around_crossings();
  void lead(std::uint32_t facet, ChainLink link, std::uint32_t vertex);
  bool lead_through_inner_end(std::uint32_t facet, ChainLink link, ChainLink crossing);
  void resolve(std::uint32_t facet, ChainLink one, ChainLink other);

  std::span<const BoundaryEdge> boundary(std::uint32_t facet) const {
    return std::span(boundary_).subspan(first_of_facet_[facet], first_of_facet_[facet + 1] - first_of_facet_[facet]);
  }
  int turn(Projection plane, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orient2d(plane, points_.pool[a], points_.pool[b], points_.pool[c]);
  }
  std::size_t link_count(std::uint32_t facet) const;
  std::array<std::uint32_t, 3> triangle(std::uint32_t face) const;
  std::vector<DirectedEdge> outline(std::uint32_t facet) const;
  void add(const TriangleMesh::Triangle& triangle);
  bool fill(Projection plane, const std::vector<DirectedEdge>& outline,
            const std::vector<TriangleMesh::Triangle>& triangles) const;
  bool add_triangulated(std::uint32_t facet);
  void add_moved(std::uint32_t facet);
  void cancel_opposite_triangles();
  TriangleMesh used_points_only();

  const TriangleMesh& mesh_;
  MeshFacets facets_;
  MovedPoints points_;
  EdgeChains edges_;
  std::vector<BoundaryEdge> boundary_;  // facet by facet
  std::vector<std::uint32_t> first_of_facet_;
  std::vector<bool> is_moved_;                  // per facet: something of it is not where it was
  std::vector<bool> is_tangled_;                // per facet: its outline may cross itself
  std::vector<bool> to_check_;                  // per facet
  std::vector<std::size_t> first_link_counts_;  // per facet
  std::vector<TriangleMesh::Triangle> triangles_;
};

std::array<std::uint32_t, 3> Snapping::triangle(std::uint32_t face) const {
  TriangleMesh::Triangle corners = mesh_.triangle(FaceId(face));
  for (std::uint32_t& corner : corners) corner = points_.numbers[corner];
  return corners;
}

std::size_t Snapping::link_count(std::uint32_t facet) const {
  std::size_t count = 0;
  for (const BoundaryEdge& side : boundary(facet)) count += edges_[side.edge].size() - 1;
  return count;
}

void Snapping::find_facets(const MovedVertices& moved) {
  is_moved_.resize(facets_.count());
  is_tangled_.resize(facets_.count());
  for (std::uint32_t face = 0; face < facets_.face_count(); ++face)
    for (const std::uint32_t vertex : mesh_.triangle(FaceId(face)))
      if (moved.movements[vertex] > 0) is_moved_[facets_->of_face(face)] = true;
  to_check_ = is_moved_;
}

/// Edges that lie upon each other now are one.
void Snapping::find_edges() {
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
void Snapping::touch_along(std::span<const std::uint32_t> edges) {
  for (const BoundaryEdge& side : boundary_)
    if (std::ranges::binary_search(edges, side.edge)) is_moved_[side.facet] = to_check_[side.facet] = true;
}

Box3 grown(Box3 box, double by) {
  box.min = box.min - Vec3{by, by, by};
  box.max = box.max + Vec3{by, by, by};
  return box;
}

void Snapping::lead_through_passed_vertices() {
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
void Snapping::lead(std::uint32_t facet, ChainLink link, std::uint32_t vertex) {
  const double detour = edges_.detour(link.edge) + edges_.distance(link, vertex);
  if (detour <= kFarthestDetour * points_.largest_movement)
    edges_.lead_through(link, vertex);
  else
    is_tangled_[facet] = true;
}

/// Leads the first link through an end of the other that lies on it. True if there is one.
bool Snapping::lead_through_inner_end(std::uint32_t facet, ChainLink link, ChainLink crossing) {
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
void Snapping::resolve(std::uint32_t facet, ChainLink one, ChainLink other) {
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
bool Snapping::lead_around_crossings() {
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
        Box3 box = unite(box_of_point(points_.pool[from]), box_of_point(points_.pool[to]));
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

/// What is left of directed edges, ascending, when those that run along each other in opposite directions are gone.
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

/// The boundary of a facet as it is now.
std::vector<DirectedEdge> Snapping::outline(std::uint32_t facet) const {
  std::vector<DirectedEdge> links;
  for (const BoundaryEdge& side : boundary(facet))
    for (std::uint32_t index = 0; index + 1 < edges_[side.edge].size(); ++index) {
      const auto [from, to] = edges_.ends({side.edge, index});
      links.push_back(side.is_reversed ? DirectedEdge(to, from) : DirectedEdge(from, to));
    }
  return without_opposites(std::move(links));
}

/// True if none of the triangles turns over and they have this boundary, without opposites, all together.
bool Snapping::fill(Projection plane, const std::vector<DirectedEdge>& outline,
                    const std::vector<TriangleMesh::Triangle>& triangles) const {
  std::vector<DirectedEdge> sides;
  for (const auto& [a, b, c] : triangles) {
    if (turn(plane, a, b, c) <= 0) return false;
    sides.insert(sides.end(), {{a, b}, {b, c}, {c, a}});
  }
  return without_opposites(std::move(sides)) == outline;
}

void Snapping::add(const TriangleMesh::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  if (a != b && b != c && c != a) triangles_.push_back(triangle);
}

/// False if the outline bounds no region.
bool Snapping::add_triangulated(std::uint32_t facet) {
  const Projection plane = facets_.projection(facet);
  const bool is_flipped = facets_.is_flipped(facet);
  std::vector<DirectedEdge> edges = outline(facet);
  if (is_flipped) {
    for (auto& [from, to] : edges) std::swap(from, to);
    edges = without_opposites(std::move(edges));
  }
  std::vector<TriangleMesh::Triangle> triangles;
  if (!triangulate(points_.pool, plane, edges, triangles) || !fill(plane, edges, triangles)) return false;
  for (auto& [a, b, c] : triangles) triangles_.push_back(is_flipped ? std::array{a, c, b} : std::array{a, b, c});
  return true;
}

/// The old triangles between the new points, and others that fill what lies between them and the chains of edges.
void Snapping::add_moved(std::uint32_t facet) {
  for (const std::uint32_t face : facets_->faces(facet)) add(triangle(face));
  for (const BoundaryEdge& side : boundary(facet)) {
    const auto chain = edges_[side.edge];
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      if (side.is_reversed)
        add({chain[0], chain[i + 1], chain[i]});
      else
        add({chain[0], chain[i], chain[i + 1]});
    }
  }
}

/// Two triangles that lie upon each other, front to front or back to back, have nothing between them.
void Snapping::cancel_opposite_triangles() {
  struct Place {
    TriangleMesh::Triangle corners;  // ascending
    bool is_odd;                     // the triangle turns the other way
    std::uint32_t number;
  };
  std::vector<Place> places;
  places.reserve(triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    auto [a, b, c] = triangles_[t];
    bool is_odd = false;
    const auto order = [&](std::uint32_t& x, std::uint32_t& y) {
      if (x < y) return;
      std::swap(x, y);
      is_odd = !is_odd;
    };
    order(a, b);
    order(b, c);
    order(a, b);
    places.push_back({{a, b, c}, is_odd, t});
  }
  std::ranges::sort(places, {}, [](const Place& p) { return std::tuple(p.corners, p.number); });
  std::vector<bool> is_cancelled(triangles_.size());
  std::vector<Place> open;  // of one set of corners, all turning the same way
  for (const Place& place : places) {
    if (!open.empty() && open.back().corners != place.corners) open.clear();
    if (!open.empty() && open.back().is_odd != place.is_odd) {
      is_cancelled[open.back().number] = is_cancelled[place.number] = true;
      open.pop_back();
    } else {
      open.push_back(place);
    }
  }
  std::size_t kept = 0;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    if (!is_cancelled[t]) triangles_[kept++] = triangles_[t];
  triangles_.resize(kept);
}

TriangleMesh Snapping::used_points_only() {
  PointArray used;
  std::vector<std::uint32_t> numbers(points_.points.size(), arrangement::kNone);
  for (TriangleMesh::Triangle& triangle : triangles_)
    for (std::uint32_t& corner : triangle) {
      if (numbers[corner] == arrangement::kNone) {
        numbers[corner] = static_cast<std::uint32_t>(used.size());
        const PointRef point = points_.pool[corner];
        used.push_back(point.is_double() ? ExactPoint(point.approx) : ExactPoint(*point.exact));
      }
      corner = numbers[corner];
    }
  return {std::move(used), triangles_};
}

SnappedMesh Snapping::run() {
  lead_through_passed_vertices();
  for (std::uint32_t facet = 0; facet < facets_.count(); ++facet) first_link_counts_.push_back(link_count(facet));
  int round = 0;
  while (round < kMaxRounds && lead_around_crossings()) ++round;
  for (std::uint32_t facet = 0; facet < facets_.count(); ++facet) {
    const bool is_simple = !is_tangled_[facet] && !to_check_[facet];
    if (!is_moved_[facet] || !is_simple || !add_triangulated(facet)) add_moved(facet);
  }
  cancel_opposite_triangles();
  return {used_points_only(), edges_.largest_detour()};
}

}  // namespace

SnappedMesh moved_mesh(const TriangleMesh& mesh, PointArray points) {
  const std::size_t count = points.size();
  // What has not moved passes over nothing.
  return snapped_mesh(mesh, {std::move(points), std::vector<double>(count)});
}

SnappedMesh snapped_mesh(const TriangleMesh& mesh, const MovedVertices& moved) {
  return Snapping(mesh, moved).run();
}

}  // namespace algebra3d
