#include "algebra3d/values/spatial_relations/point_location.h"

#include <algorithm>
#include <optional>

#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// False if the point cannot be on the triangle, by rounded coordinates, which rounding keeps in order.
bool may_hold(const TriangleRef& triangle, const Vec3& p) {
  const Vec3 &a = triangle[0].approx, &b = triangle[1].approx, &c = triangle[2].approx;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (p[axis] < std::min({a[axis], b[axis], c[axis]}) || p[axis] > std::max({a[axis], b[axis], c[axis]}))
      return false;
  return true;
}

bool is_on_boundary_edge(const TriangleMesh& mesh, FaceId face, PointRef point) {
  const auto is_boundary_with_point = [&](HalfedgeId h) {
    return mesh.is_boundary(h) && is_on_segment(point, mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)));
  };
  const auto edges = halfedges_of(mesh, face);
  return std::any_of(edges.begin(), edges.end(), is_boundary_with_point);
}

/// Places points of one task. A point on a face counts as on it whatever its winding number.
void place_together(std::span<const PointRef> points, const Geometry& solid, std::span<Placement> result) {
  std::vector<Box3> boxes;
  boxes.reserve(points.size());
  for (const PointRef& point : points) boxes.push_back(box_of(point));
  std::vector<std::int32_t> winding_numbers(points.size());
  std::ranges::fill(result, Placement::outside);
  FaceId face;
  TriangleRef corners{Vec3{}, Vec3{}, Vec3{}};
  solid.hierarchy().for_each_on_upward_rays(boxes, [&](auto i, auto f) {
    if (face != FaceId(f)) corners = solid.mesh.corners(face = FaceId(f));
    if (may_hold(corners, points[i].approx) && is_on_triangle(points[i], corners)) result[i] = Placement::boundary;
    const LineCrossing crossing = cross_vertical_line(points[i], corners);
    if (crossing.side == -1) winding_numbers[i] += crossing.sign;
  });
  for (std::size_t i = 0; i < points.size(); ++i)
    if (result[i] == Placement::outside && winding_numbers[i] != 0) result[i] = Placement::inside;
}

/// Locates points by rays, in parallel.
std::vector<Placement> place_by_rays(std::span<const PointRef> points, const Geometry& solid) {
  // So many that most nodes of a large hierarchy are reached by several.
  constexpr std::size_t kPointsOfTask = 16384;
  std::vector<Placement> result(points.size());
  const std::size_t task_count = (points.size() + kPointsOfTask - 1) / kPointsOfTask;
  parallel_for(task_count, 1, [&](std::size_t task) {
    const std::size_t begin = task * kPointsOfTask, count = std::min(kPointsOfTask, points.size() - begin);
    place_together(points.subspan(begin, count), solid, std::span(result).subspan(begin, count));
  });
  return result;
}

/// The cells of a solid in which so many points are to be located; null if they are not worth their cost.
const SolidCells* cells_for(std::size_t points, const Geometry& solid) {
  return solid.cells_after(points, [&](std::span<const Vec3> middles) {
    const std::vector<Placement> places = place_by_rays(std::vector<PointRef>(middles.begin(), middles.end()), solid);
    std::vector<bool> are_inside;
    for (const Placement place : places) are_inside.push_back(place == Placement::inside);
    return are_inside;
  });
}

/// Where a point lies, if its cell tells.
std::optional<Placement> place_by_cell(PointRef point, const SolidCells& cells) {
  if (!point.is_double()) return std::nullopt;
  const std::optional<bool> is_inside = cells.is_inside(point.approx);
  if (!is_inside) return std::nullopt;
  return *is_inside ? Placement::inside : Placement::outside;
}

}  // namespace

Placement place_in_solid(PointRef point, const Geometry& solid) {
  const Box3 box = box_of(point);
  if (!solid.box.intersects(box)) return Placement::outside;
  if (const SolidCells* const cells = cells_for(1, solid))
    if (const auto place = place_by_cell(point, *cells)) return *place;
  int winding_number = 0;
  bool is_on_face = false;
  solid.hierarchy().for_each_on_vertical_ray(box, 1, [&](auto face) {
    if (is_on_face) return;
    const TriangleRef corners = solid.mesh.corners(FaceId(face));
    is_on_face = may_hold(corners, point.approx) && is_on_triangle(point, corners);
    const LineCrossing crossing = cross_vertical_line(point, corners);
    if (crossing.side == -1) winding_number += crossing.sign;
  });
  if (is_on_face) return Placement::boundary;
  return winding_number != 0 ? Placement::inside : Placement::outside;
}

std::vector<Placement> place_in_solid(std::span<const PointRef> points, const Geometry& solid) {
  const SolidCells* const cells = cells_for(points.size(), solid);
  if (cells == nullptr) return place_by_rays(points, solid);
  std::vector<Placement> result(points.size());
  std::vector<PointRef> open;
  std::vector<std::size_t> places;  // of these
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const auto place = place_by_cell(points[i], *cells)) {
      result[i] = *place;
    } else {
      open.push_back(points[i]);
      places.push_back(i);
    }
  }
  const std::vector<Placement> by_rays = place_by_rays(open, solid);
  for (std::size_t k = 0; k < places.size(); ++k) result[places[k]] = by_rays[k];
  return result;
}

Placement place_by_faces_above(PointRef point, const TriangleMesh& faces) {
  int winding_number = 0;
  for (std::size_t f = 0; f < faces.face_count(); ++f) {
    const TriangleRef corners = faces.corners(FaceId(f));
    if (may_hold(corners, point.approx) && is_on_triangle(point, corners)) return Placement::boundary;
    const LineCrossing crossing = cross_vertical_line(point, corners);
    if (crossing.side == -1) winding_number += crossing.sign;
  }
  return winding_number != 0 ? Placement::inside : Placement::outside;
}

Placement place_on_surface(PointRef point, const Geometry& surface) {
  Placement result = Placement::outside;
  const Box3 box = box_of(point);
  if (!surface.box.intersects(box)) return result;
  surface.hierarchy().for_each_meeting(box, [&](auto face) {
    const TriangleRef corners = surface.mesh.corners(FaceId(face));
    if (!may_hold(corners, point.approx) || !is_on_triangle(point, corners)) return true;
    const bool is_at_edge = is_on_boundary_edge(surface.mesh, FaceId(face), point);
    result = is_at_edge ? Placement::boundary : Placement::inside;
    return !is_at_edge;
  });
  return result;
}

}  // namespace algebra3d
