#include "algebra3d/kernel/rounding/detail/snapped_vertices.h"

#include <cmath>
#include <utility>

namespace algebra3d {
namespace {

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

}  // namespace

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

}  // namespace algebra3d
