#include "algebra3d/values/measures/contact_area.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/exact/real_sum.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// A point of a plane in projection.
struct PlanarPoint {
  Rational x, y;
};
using ConvexPolygon = std::vector<PlanarPoint>;

/// Twice the signed area of a triangle.
Rational turn(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The triangle in projection, counter-clockwise.
ConvexPolygon projected(const TriangleRef& triangle, Projection plane) {
  ConvexPolygon polygon;
  for (const PointRef& corner : triangle)
    polygon.push_back({corner.coordinate(first_axis(plane)), corner.coordinate(second_axis(plane))});
  if (turn(polygon[0], polygon[1], polygon[2]).sign() < 0) std::swap(polygon[1], polygon[2]);
  return polygon;
}

/// The part of a polygon on the left of the line through a and b.
ConvexPolygon clipped(const ConvexPolygon& polygon, const PlanarPoint& a, const PlanarPoint& b) {
  ConvexPolygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanarPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational side_of_p = turn(a, b, p), side_of_q = turn(a, b, q);
    if (side_of_p.sign() >= 0) result.push_back(p);
    if (side_of_p.sign() * side_of_q.sign() >= 0) continue;
    const Rational share = side_of_p / (side_of_p - side_of_q);
    result.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
  }
  return result;
}

/// Twice the area of the common part of two triangles of one plane, in projection.
Rational doubled_common_area(const TriangleRef& s, const TriangleRef& t, Projection plane) {
  ConvexPolygon common = projected(s, plane);
  const ConvexPolygon other = projected(t, plane);
  for (std::size_t i = 0; i < 3; ++i) common = clipped(common, other[i], other[(i + 1) % 3]);
  Rational area;
  for (std::size_t i = 2; i < common.size(); ++i) area += turn(common[0], common[i - 1], common[i]);
  return area;
}

/// The square of the area whose double is given in projection, in the plane of a triangle.
Rational squared_area(const Rational& doubled, const TriangleRef& triangle, Projection plane) {
  const RationalVec3 corner = triangle[0].rational();
  const RationalVec3 normal = cross(triangle[1].rational() - corner, triangle[2].rational() - corner);
  const Rational& across = normal[3 - first_axis(plane) - second_axis(plane)];
  return doubled * doubled * dot(normal, normal) / (4 * across * across);
}

/// Adds a root as two doubles, with twice the digits of one. False beyond the range of doubles.
bool add_root(const Rational& squared, RealSum& sum) {
  const double rounded = squared.nearest_root();
  if (!std::isfinite(rounded)) return false;
  if (rounded == 0) return true;
  // A step of Newton's method doubles the digits.
  const Rational root = (Rational(rounded) + squared / Rational(rounded)) / 2;
  const double high = root.nearest_double();
  if (!std::isfinite(high)) return false;
  sum.add(high);
  sum.add((root - Rational(high)).nearest_double());
  return true;
}

}  // namespace

Result<double> contact_area(const Geometry& a, const Geometry& b, const Monitor& monitor) {
  if (!a.box.intersects(b.box)) return 0.0;
  std::map<FaceId, Rational> doubled_areas;  // in the projections of the faces of a
  a.hierarchy().for_each_pair_with(
      b.hierarchy(),
      [&](std::uint32_t f, std::uint32_t g) {
        const TriangleRef s = a.mesh.corners(FaceId(f)), t = b.mesh.corners(FaceId(g));
        if (contact_of_triangles(s, t).kind == Contact::area)
          doubled_areas[FaceId(f)] += doubled_common_area(s, t, dominant_projection(s[0], s[1], s[2]));
        return true;
      },
      [&] { return !monitor.is_cancelled(); });
  A3D_TRY(monitor.check());
  RealSum sum;
  for (const auto& [face, doubled] : doubled_areas) {
    const TriangleRef triangle = a.mesh.corners(face);
    const Projection plane = dominant_projection(triangle[0], triangle[1], triangle[2]);
    if (!add_root(squared_area(doubled, triangle, plane), sum)) return Box3::kInfinity;
  }
  return sum.total().nearest_double();
}

}  // namespace algebra3d
