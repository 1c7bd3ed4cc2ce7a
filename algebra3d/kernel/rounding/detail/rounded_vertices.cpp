#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

Vec3 nearest(const CoordinateGrid& grid, const Vec3& point) {
  return {grid.nearest(point.x), grid.nearest(point.y), grid.nearest(point.z)};
}

}  // namespace

// The double nearest to an exact coordinate is at most half a spacing away from it.
double distance_to_rounded(const PointRef& point, const Vec3& rounded) {
  if (point.is_double() && point.approx == rounded) return 0;
  Vec3 difference;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = std::abs(point.approx[axis]);
    const double half_spacing = point.is_double() ? 0 : (std::nextafter(size, Box3::kInfinity) - size) / 2;
    difference[axis] = std::abs(point.approx[axis] - rounded[axis]) + half_spacing;
  }
  // Five roundings, some of which may come down to nothing.
  const double length = std::hypot(difference.x, difference.y, difference.z);
  return length * (1 + 8 * std::numeric_limits<double>::epsilon()) + std::numeric_limits<double>::denorm_min();
}

std::vector<bool> are_moved(const TriangleMesh& mesh, const CoordinateGrid& grid) {
  std::vector<bool> result;
  result.reserve(mesh.vertex_count());
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const PointRef given = mesh.points()[i];
    result.push_back(!given.is_double() || given.approx != nearest(grid, given.approx));
  }
  return result;
}

RoundedVertices rounded_vertices(const TriangleMesh& mesh, const CoordinateGrid& grid) {
  RoundedVertices result;
  std::vector<Vec3> rounded(mesh.vertex_count());
  result.movements.resize(mesh.vertex_count());
  constexpr std::size_t kVerticesPerTask = 20'000;
  parallel_for(mesh.vertex_count(), kVerticesPerTask, [&](std::size_t i) {
    const PointRef given = mesh.points()[i];
    rounded[i] = nearest(grid, given.approx);
    result.movements[i] = distance_to_rounded(given, rounded[i]);
  });
  result.are_finite = std::ranges::all_of(rounded, is_finite);
  if (!result.are_finite) return result;
  for (const double movement : result.movements) {
    if (movement > 0) ++result.moved;
    result.largest_movement = std::max(result.largest_movement, movement);
  }
  result.points = PointArray(std::move(rounded));
  return result;
}

std::vector<bool> faces_that_move(const TriangleMesh& mesh, const std::vector<double>& movements) {
  std::vector<bool> result(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.triangle(FaceId(f));
    result[f] = movements[a] > 0 || movements[b] > 0 || movements[c] > 0;
  }
  return result;
}

bool are_apart(const RoundedVertices& vertices) {
  PointTable moved(vertices.moved);
  const auto is_moved = [&](std::size_t v) { return vertices.movements[v] > 0; };
  for (std::size_t v = 0; v < vertices.points.size(); ++v) {
    const std::size_t count = moved.size();
    if (is_moved(v) && moved.intern(vertices.points[v]) < count) return false;
  }
  for (std::size_t v = 0; v < vertices.points.size(); ++v)
    if (!is_moved(v) && moved.find(vertices.points[v]) != kNone) return false;
  return true;
}

double rounded_up(double length) {
  return length * (1 + 0x1p-40);
}

}  // namespace algebra3d
