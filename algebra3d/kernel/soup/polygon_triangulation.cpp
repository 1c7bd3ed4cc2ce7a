#include "algebra3d/kernel/soup/polygon_triangulation.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/planar/sweep_triangulation.h"
#include "algebra3d/kernel/soup/loop_triangulation.h"
#include "algebra3d/kernel/soup/rounding_noise.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

using Polygon = std::vector<Vec3>;
using IndexTriangle = TriangleMesh::Triangle;

/// Without corners that are equal to the one before.
Polygon corners_of(const PolygonSoup& soup, std::size_t face) {
  Polygon polygon;
  for (const std::uint32_t corner : soup.face(face))
    if (polygon.empty() || polygon.back() != soup.points[corner]) polygon.push_back(soup.points[corner]);
  while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
  return polygon;
}

/// Twice the vector area. Source: [newell1972], as sums of cross products.
Vec3 normal_of(const Polygon& polygon) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum = sum + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return sum;
}

std::vector<IndexTriangle> fan(std::size_t corner_count) {
  std::vector<IndexTriangle> triangles;
  for (std::uint32_t i = 1; i + 1 < corner_count; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

bool is_convex(const Polygon& polygon, const Vec3& normal) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 turn = cross(polygon[(i + 1) % n] - polygon[i], polygon[(i + 2) % n] - polygon[(i + 1) % n]);
    if (!(dot(turn, normal) > 0)) return false;
  }
  // A star turns one way as well, but more than once round.
  return std::ranges::all_of(fan(n), [&](const IndexTriangle& t) {
    return dot(cross(polygon[t[1]] - polygon[0], polygon[t[2]] - polygon[0]), normal) > 0;
  });
}

Projection along_nearest_axis(const Vec3& normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  return x > y && x > z ? Projection::yz : y > z ? Projection::zx : Projection::xy;
}

/// Empty if the polygon touches or crosses itself in the projection.
std::vector<IndexTriangle> projected_triangles(const Polygon& polygon, const Vec3& normal) {
  const Projection projection = along_nearest_axis(normal);
  const bool is_flipped = normal[static_cast<std::size_t>(projection)] < 0;
  PointTable pool;
  std::vector<std::uint32_t> numbers;
  for (const Vec3& corner : polygon) numbers.push_back(pool.intern(PointRef(corner)));
  if (pool.size() != polygon.size()) return {};
  std::vector<DirectedEdge> edges;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint32_t from = numbers[i], to = numbers[(i + 1) % numbers.size()];
    edges.push_back(is_flipped ? DirectedEdge(to, from) : DirectedEdge(from, to));
  }
  std::vector<IndexTriangle> triangles;
  if (!triangulate_by_sweep(pool, projection, edges, triangles) || triangles.size() + 2 != polygon.size()) return {};
  // Points are numbered in the order of the corners.
  if (is_flipped)
    for (IndexTriangle& triangle : triangles) std::swap(triangle[1], triangle[2]);
  return triangles;
}

std::vector<IndexTriangle> triangulate_polygon(const Polygon& polygon) {
  const Vec3 normal = normal_of(polygon);
  if (polygon.size() <= 3 || is_convex(polygon, normal)) return fan(polygon.size());
  if (auto triangles = projected_triangles(polygon, normal); !triangles.empty()) return triangles;
  return triangulate_loop({polygon, polygon}, LoopMeasure::area);
}

/// A corner and its distance from the plane of its polygon.
struct FarCorner {
  double distance = 0;
  Vec3 where;
};

FarCorner farthest_from_plane(const Polygon& polygon) {
  const Vec3 normal = normal_of(polygon);
  const double size = length(normal);
  FarCorner farthest;
  if (!(size > 0) || !std::isfinite(size)) return farthest;
  Vec3 middle;
  for (const Vec3& corner : polygon) middle = middle + (1 / static_cast<double>(polygon.size())) * corner;
  for (const Vec3& corner : polygon) {
    const double distance = std::abs(dot((1 / size) * normal, corner - middle));
    if (distance > farthest.distance) farthest = {distance, corner};
  }
  return farthest;
}

}  // namespace

std::string BentPolygons::text() const {
  if (count == 0) return {};
  return fmt::format("{} not planar, up to {:.3g} (face {}, near ({:.6g} {:.6g} {:.6g}))",
                     count == 1 ? "1 polygon is" : fmt::format("{} polygons are", count), largest, face + 1, where.x,
                     where.y, where.z);
}

BentPolygons bent_polygons(const PolygonSoup& polygons) {
  const RoundingNoise noise(polygons.points);
  BentPolygons result;
  for (std::size_t face = 0; face < polygons.face_count(); ++face) {
    poll_interruption_at(face);
    if (polygons.face(face).size() <= 3) continue;
    const Polygon polygon = corners_of(polygons, face);
    const FarCorner far = farthest_from_plane(polygon);
    if (!(far.distance > 0) || far.distance <= noise.within(Box3::around(polygon))) continue;
    ++result.count;
    if (far.distance <= result.largest) continue;
    result.largest = far.distance;
    result.face = face;
    result.where = far.where;
  }
  return result;
}

TriangleSoup triangles_of(const PolygonSoup& polygons) {
  TriangleSoup soup;
  soup.name = polygons.name;
  for (std::size_t face = 0; face < polygons.face_count(); ++face) {
    poll_interruption_at(face);
    const auto corners = polygons.face(face);
    if (corners.size() == 3) {
      soup.triangles.push_back({polygons.points[corners[0]], polygons.points[corners[1]], polygons.points[corners[2]]});
      continue;
    }
    const Polygon polygon = corners_of(polygons, face);
    if (polygon.size() < 3) continue;
    for (const auto& [a, b, c] : triangulate_polygon(polygon))
      soup.triangles.push_back({polygon[a], polygon[b], polygon[c]});
  }
  return soup;
}

}  // namespace algebra3d
