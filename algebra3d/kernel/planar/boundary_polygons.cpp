#include "algebra3d/kernel/planar/boundary_polygons.h"

#include <algorithm>
#include <compare>

#include "algebra3d/kernel/planar/detail/edge_triangulation.h"
#include "algebra3d/kernel/planar/noding.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using planar::HalfedgeId;
using planar::PlanePoints;
using planar::Subdivision;
using planar::VertexId;

/// A cycle of vertices that touches itself nowhere and turns at each; the smallest comes first.
struct TracedCycle {
  std::vector<VertexId> vertices;
  bool is_hole;
};
using TracedFace = std::vector<TracedCycle>;

/// Follows the boundaries of the patches of the inside.
class BoundaryTracer {
 public:
  explicit BoundaryTracer(const planar::EdgeTriangulation& edges)
      : points_(edges.points()),
        triangulation_(edges.triangulation()),
        is_traced_(triangulation_.halfedges().size()),
        place_in_path_(points_.size(), kNone) {}

  /// The cycles of the patch of these triangles: the outer one, then holes in order.
  TracedFace trace(std::span<const HalfedgeId> triangles);
  bool is_before(const TracedFace& a, const TracedFace& b) const { return is_before(a[0], b[0]); }

 private:
  bool is_boundary(HalfedgeId h) const { return planar::mark_has_inside(triangulation_.mark(h)); }
  bool is_before(const TracedCycle& a, const TracedCycle& b) const;
  void walk(HalfedgeId start, TracedFace& face);
  void cut_off(std::size_t begin, TracedFace& face);
  HalfedgeId next_on_boundary(HalfedgeId h) const;

  const PlanePoints& points_;
  const Subdivision& triangulation_;
  IdVector<HalfedgeId, bool> is_traced_;
  std::vector<VertexId> path_;                       // vertices since the start, without the cycles that are cut off
  IdVector<VertexId, std::uint32_t> place_in_path_;  // kNone: it is not there
};

/// By the first two corners. Two cycles that begin in one corner go on to different ones.
bool BoundaryTracer::is_before(const TracedCycle& a, const TracedCycle& b) const {
  const std::size_t place = a.vertices[0] == b.vertices[0] ? 1 : 0;
  return points_.is_before(a.vertices[place], b.vertices[place]);
}

/// The half-edge that goes on at the target, with the same triangles between.
HalfedgeId BoundaryTracer::next_on_boundary(HalfedgeId h) const {
  HalfedgeId next = triangulation_.next(h);
  while (!is_boundary(next)) next = triangulation_.next(Subdivision::twin(next));
  return next;
}

/// Makes a cycle of the end of the path.
void BoundaryTracer::cut_off(std::size_t begin, TracedFace& face) {
  TracedCycle cycle;
  const std::size_t count = path_.size() - begin;
  const auto vertex = [&](std::size_t i) { return path_[begin + i % count]; };
  std::size_t first = 0;
  for (std::size_t i = 1; i < count; ++i)
    if (points_.is_before(vertex(i), vertex(first))) first = i;
  cycle.is_hole = points_.turn(vertex(first + count - 1), vertex(first), vertex(first + 1)) < 0;
  for (std::size_t i = first; i < first + count; ++i) {
    poll_interruption_at(i);
    if (points_.turn(vertex(i + count - 1), vertex(i), vertex(i + 1)) != 0) cycle.vertices.push_back(vertex(i));
  }
  for (std::size_t i = begin; i < path_.size(); ++i) place_in_path_[path_[i]] = kNone;
  path_.resize(begin);
  face.push_back(std::move(cycle));
}

void BoundaryTracer::walk(HalfedgeId start, TracedFace& face) {
  HalfedgeId h = start;
  do {
    poll_interruption();
    is_traced_[h] = true;
    const VertexId vertex = triangulation_.origin(h);
    if (place_in_path_[vertex] != kNone) cut_off(place_in_path_[vertex], face);
    place_in_path_[vertex] = static_cast<std::uint32_t>(path_.size());
    path_.push_back(vertex);
    h = next_on_boundary(h);
  } while (h != start);
  cut_off(0, face);
}

TracedFace BoundaryTracer::trace(std::span<const HalfedgeId> triangles) {
  TracedFace face;
  for (const HalfedgeId triangle : triangles) {
    const HalfedgeId second = triangulation_.next(triangle);
    for (const HalfedgeId h : {triangle, second, triangulation_.next(second)})
      if (is_boundary(h) && !is_traced_[h]) walk(h, face);
  }
  std::sort(face.begin(), face.end(), [&](const TracedCycle& a, const TracedCycle& b) {
    return a.is_hole != b.is_hole ? b.is_hole : is_before(a, b);
  });
  return face;
}

void append(const PlanePoints& points, const TracedFace& face, Polygons& polygons) {
  for (const TracedCycle& cycle : face) {
    for (const VertexId vertex : cycle.vertices) polygons.corners.push_back(points[vertex]);
    polygons.cycle_ends.push_back(static_cast<std::uint32_t>(polygons.corners.size()));
  }
  polygons.face_ends.push_back(static_cast<std::uint32_t>(polygons.cycle_ends.size()));
}

}  // namespace

Result<Polygons> boundary_polygons(const PointArray& points, std::span<const DirectedEdge> noded_edges,
                                   const Monitor& monitor) {
  planar::EdgeTriangulation edges(points, noded_edges);
  A3D_TRY(edges.build(monitor));
  A3D_TRY(edges.check_one_direction());
  A3D_ASSIGN(const planar::InsideTriangles inside, edges.find_inside());
  BoundaryTracer tracer(edges);
  std::vector<TracedFace> faces;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : inside.patch_ends) {
    faces.push_back(tracer.trace(std::span(inside.halfedges).subspan(begin, end - begin)));
    begin = end;
  }
  std::sort(faces.begin(), faces.end(),
            [&](const TracedFace& a, const TracedFace& b) { return tracer.is_before(a, b); });
  Polygons result;
  for (const TracedFace& face : faces) append(edges.points(), face, result);
  return result;
}

Result<Polygons> boundary_polygons(const Polygons& oriented, const Monitor& monitor) {
  A3D_ASSIGN(const std::vector<DirectedEdge> edges, noded(oriented.corners, segments_of(oriented), monitor));
  return boundary_polygons(oriented.corners, edges, monitor);
}

}  // namespace algebra3d
