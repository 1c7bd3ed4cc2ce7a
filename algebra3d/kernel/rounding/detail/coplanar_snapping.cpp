#include "algebra3d/kernel/rounding/detail/coplanar_snapping.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/arrangement/coplanar_facets.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/id_vector.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// The vertices of a mesh while they are moved into planes; each has up to three planes that it must not leave. Exact.
class SnappedVertices {
 public:
  /// The mesh must outlive this. No vertex moves farther than `farthest` from its place there.
  SnappedVertices(const TriangleMesh& mesh, double farthest)
      : mesh_(mesh), farthest_(farthest), moving_(mesh.vertex_count()) {}

  /// The place of a vertex now.
  RationalVec3 place(VertexId vertex) const;
  /// The nearest point of the plane that also lies in all planes which the vertex must not leave; none if there is
  /// none, or if it is too far away.
  std::optional<RationalVec3> place_in(const ExactPlane& plane, VertexId vertex) const;
  /// Moves a vertex to a point in all its planes.
  void move(VertexId vertex, RationalVec3 to);
  /// Adds a plane that the vertex, which lies in it, must not leave.
  void keep_in(const ExactPlane& plane, VertexId vertex);

  /// The positions of all vertices, with the distances from the old ones.
  MovedVertices result() const;

 private:
  struct MovingVertex {
    RationalVec3 place;
    std::vector<ExactPlane> planes;
  };

  MovingVertex& moving(VertexId vertex);
  std::span<const ExactPlane> kept_planes(VertexId vertex) const;

  const TriangleMesh& mesh_;
  double farthest_;
  IdVector<VertexId, std::optional<MovingVertex>> moving_;
};

/// The direction in which a point gets to a plane without leaving those that it lies in; zero if it cannot.
RationalVec3 way_to(const ExactPlane& plane, std::span<const ExactPlane> kept) {
  switch (kept.size()) {
    case 0:
      return plane.normal;
    case 1:
      return dot(kept[0].normal, kept[0].normal) * plane.normal - dot(kept[0].normal, plane.normal) * kept[0].normal;
    case 2:
      return cross(kept[0].normal, kept[1].normal);
    default:
      return {};
  }
}

/// The length; rounded.
double length(const RationalVec3& v) {
  return std::hypot(v.x.nearest_double(), v.y.nearest_double(), v.z.nearest_double());
}

RationalVec3 SnappedVertices::place(VertexId vertex) const {
  return moving_[vertex] ? moving_[vertex]->place : mesh_.point(vertex).rational();
}

SnappedVertices::MovingVertex& SnappedVertices::moving(VertexId vertex) {
  if (!moving_[vertex]) moving_[vertex] = MovingVertex{place(vertex), {}};
  return *moving_[vertex];
}

std::span<const ExactPlane> SnappedVertices::kept_planes(VertexId vertex) const {
  if (!moving_[vertex]) return {};
  return moving_[vertex]->planes;
}

std::optional<RationalVec3> SnappedVertices::place_in(const ExactPlane& plane, VertexId vertex) const {
  const RationalVec3 from = place(vertex);
  const Rational height = plane.evaluate(from);
  if (height.sign() == 0) return from;
  const RationalVec3 way = way_to(plane, kept_planes(vertex));
  const Rational climb = dot(way, plane.normal);
  if (climb.sign() == 0) return std::nullopt;
  const RationalVec3 to = from - (height / climb) * way;
  if (!(length(to - mesh_.point(vertex).rational()) <= farthest_)) return std::nullopt;
  return to;
}

void SnappedVertices::move(VertexId vertex, RationalVec3 to) {
  moving(vertex).place = std::move(to);
}

void SnappedVertices::keep_in(const ExactPlane& plane, VertexId vertex) {
  MovingVertex& kept = moving(vertex);
  const bool is_new = dot(way_to(plane, kept.planes), plane.normal).sign() != 0;
  if (is_new) kept.planes.push_back(plane);
}

MovedVertices SnappedVertices::result() const {
  MovedVertices moved;
  for (const VertexId v : moving_.ids()) {
    const ExactPoint given = mesh_.points().point(v.index());
    moved.points.push_back(moving_[v] ? ExactPoint(moving_[v]->place) : given);
    moved.movements.push_back(moving_[v] ? length(moving_[v]->place - given.rational()) : 0);
  }
  return moved;
}

constexpr double kFarthest = 4;  // in terms of the reach

using SnapFacetId = StrongId<struct SnapFacetTag>;
using FacetPair = std::pair<SnapFacetId, SnapFacetId>;

/// A facet that may be snapped.
struct SnapFacet {
  std::vector<VertexId> vertices;   // ascending
  FaceId face;                      // the largest of its triangles
  std::optional<ExactPlane> plane;  // in which it lies now, once that is asked for
  bool is_bent = false;             // it lies in no plane any more
  Vec3 normal;                      // of all its triangles together, twice their area long; rounded
  Box3 box;

  double area() const { return std::sqrt(dot(normal, normal)); }
  Box3 box_within(double reach) const {
    const Vec3 margin{reach, reach, reach};
    return {box.min - margin, box.max + margin};
  }
};

SnapFacet snap_facet(const TriangleMesh& solid, std::span<const FaceId> faces) {
  SnapFacet facet;
  double largest = -1;
  for (const FaceId face : faces) {
    const TriangleRef corners = solid.corners(face);
    const Vec3 normal = cross(corners[1].approx - corners[0].approx, corners[2].approx - corners[0].approx);
    if (const double area = dot(normal, normal); area > largest) {
      largest = area;
      facet.face = face;
    }
    facet.normal = facet.normal + normal;
    facet.box.extend(box_of_triangle(corners));
    for (const std::uint32_t vertex : solid.triangle(face)) facet.vertices.emplace_back(vertex);
  }
  std::ranges::sort(facet.vertices);
  facet.vertices.erase(std::unique(facet.vertices.begin(), facet.vertices.end()), facet.vertices.end());
  return facet;
}

ExactPlane plane_of(const TriangleRef& triangle) {
  const RationalVec3 corner = triangle[0].rational();
  return ExactPlane::spanned(corner, triangle[1].rational() - corner, triangle[2].rational() - corner)->canonical();
}

class CoplanarSnapping {
 public:
  CoplanarSnapping(const TriangleMesh& solid, const std::vector<bool>& in_question, double reach);

  MovedVertices run();

 private:
  std::vector<FacetPair> parallel_pairs() const;
  bool snap(SnapFacetId facet, SnapFacetId target);
  void bend_facets_at(VertexId vertex);
  std::vector<VertexId> close_vertices(const SnapFacet& facet, const SnapFacet& target, const ExactPlane& plane) const;
  const ExactPlane& plane_of_facet(SnapFacetId facet);

  const TriangleMesh& solid_;
  double reach_;
  SnappedVertices vertices_;
  IdVector<SnapFacetId, SnapFacet> facets_;
  std::vector<std::pair<VertexId, SnapFacetId>> facets_of_vertices_;  // ascending
};

CoplanarSnapping::CoplanarSnapping(const TriangleMesh& solid, const std::vector<bool>& in_question, double reach)
    : solid_(solid), reach_(reach), vertices_(solid, kFarthest * reach) {
  const CoplanarFacets all(solid);
  for (const CoplanarFacetId id : all.ids()) {
    SnapFacet facet = snap_facet(solid, all.faces(id));
    if (std::ranges::any_of(facet.vertices, [&](VertexId v) { return in_question[v.index()]; }))
      facets_.push_back(std::move(facet));
  }
  for (const SnapFacetId id : facets_.ids())
    for (const VertexId vertex : facets_[id].vertices) facets_of_vertices_.emplace_back(vertex, id);
  std::ranges::sort(facets_of_vertices_);
}

/// Pairs of a smaller and a larger facet; those with the largest second one first.
std::vector<FacetPair> CoplanarSnapping::parallel_pairs() const {
  constexpr double kNearlyParallel = 0.99;
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const SnapFacetId id : facets_.ids()) entries.push_back({facets_[id].box_within(reach_), id.index()});
  std::vector<FacetPair> pairs;
  rtree::for_each_pair(rtree::RTree<std::uint32_t>::bulk_load(entries), [&](std::uint32_t i, std::uint32_t j) {
    const SnapFacetId a(i), b(j);
    const double cosine = dot(facets_[a].normal, facets_[b].normal) / (facets_[a].area() * facets_[b].area());
    if (!(std::abs(cosine) > kNearlyParallel)) return;
    pairs.push_back(facets_[a].area() <= facets_[b].area() ? std::pair(a, b) : std::pair(b, a));
  });
  std::ranges::sort(pairs, {}, [&](const FacetPair& pair) { return std::tuple(-facets_[pair.second].area(), pair); });
  return pairs;
}

/// All vertices of the facet, if all are close to the plane; else those that are close to the target facet.
std::vector<VertexId> CoplanarSnapping::close_vertices(const SnapFacet& facet, const SnapFacet& target,
                                                       const ExactPlane& plane) const {
  const double normal = length(plane.normal);
  const auto is_close = [&](VertexId v) {
    return std::abs(plane.evaluate(vertices_.place(v)).nearest_double()) <= reach_ * normal;
  };
  std::vector<VertexId> close;
  for (const VertexId vertex : facet.vertices)
    if (is_close(vertex)) close.push_back(vertex);
  if (close.size() == facet.vertices.size()) return close;
  const Box3 around = target.box_within(reach_);
  std::erase_if(close, [&](VertexId v) { return !around.contains(solid_.point(v).approx); });
  return close;
}

const ExactPlane& CoplanarSnapping::plane_of_facet(SnapFacetId facet) {
  auto& plane = facets_[facet].plane;
  if (!plane) plane = plane_of(solid_.corners(facets_[facet].face));
  return *plane;
}

/// Moves vertices of a facet into the plane of the target. False, with nothing moved, if the target is bent, or if a
/// vertex would move too far or out of a plane that it must not leave.
bool CoplanarSnapping::snap(SnapFacetId facet, SnapFacetId target) {
  if (facets_[target].is_bent) return false;
  const ExactPlane plane = plane_of_facet(target);
  std::vector<std::pair<VertexId, RationalVec3>> moves;
  for (const VertexId vertex : close_vertices(facets_[facet], facets_[target], plane)) {
    auto to = vertices_.place_in(plane, vertex);
    if (!to) return false;
    moves.emplace_back(vertex, *std::move(to));
  }
  const auto stays = [&](const auto& move) { return vertices_.place(move.first) == move.second; };
  if (std::ranges::all_of(moves, stays)) return true;
  for (const VertexId vertex : facets_[target].vertices) vertices_.keep_in(plane, vertex);
  if (moves.size() == facets_[facet].vertices.size()) {
    facets_[facet].plane = plane;
    facets_[facet].is_bent = false;
  }
  for (auto& [vertex, to] : moves) {
    vertices_.move(vertex, std::move(to));
    vertices_.keep_in(plane, vertex);
  }
  for (const auto& move : moves) bend_facets_at(move.first);
  return true;
}

/// Notes which facets the vertex has left.
void CoplanarSnapping::bend_facets_at(VertexId vertex) {
  auto place = std::ranges::lower_bound(facets_of_vertices_, std::pair(vertex, SnapFacetId(0)));
  for (; place != facets_of_vertices_.end() && place->first == vertex; ++place)
    if (SnapFacet& facet = facets_[place->second]; !facet.is_bent)
      facet.is_bent = plane_of_facet(place->second).evaluate(vertices_.place(vertex)).sign() != 0;
}

MovedVertices CoplanarSnapping::run() {
  for (const auto& [smaller, larger] : parallel_pairs())
    if (!snap(smaller, larger)) snap(larger, smaller);
  return vertices_.result();
}

}  // namespace

MovedVertices snap_coplanar(const TriangleMesh& solid, const std::vector<bool>& in_question, double reach) {
  return CoplanarSnapping(solid, in_question, reach).run();
}

}  // namespace algebra3d
