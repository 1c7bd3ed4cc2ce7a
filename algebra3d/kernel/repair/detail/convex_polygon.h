#pragma once

#include <array>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// The corners of a triangle, rounded or scaled.
using Triangle3 = std::array<Vec3, 3>;

/// A convex polygon in space: its corners in order; may be empty. Its measures are rounded, so no decision on a solid
/// may depend on them.
struct ConvexPolygon {
  std::vector<Vec3> corners;

  bool is_empty() const { return corners.empty(); }
  double area() const;
  /// The mean of the corners, a point inside.
  Vec3 middle() const;
  /// The triangles of the fan from the first corner.
  std::vector<Triangle3> triangles() const;
};

/// A plane, given by a point and a unit normal.
struct OrientedPlane {
  Vec3 point, normal;

  /// The signed distance of a point, positive on the side of the normal.
  double height(const Vec3& p) const { return dot(p - point, normal); }
};

/// The parts of a polygon behind a plane and in front of it.
struct PlaneSplit {
  ConvexPolygon behind, before;
};

/// Cuts a polygon at a plane. A polygon that reaches no farther than `noise` beyond the plane is not cut.
PlaneSplit split(const ConvexPolygon& polygon, const OrientedPlane& plane, double noise);

/// The length of the part of a segment within a polygon of the same plane. `normal`: the polygon's unit normal.
double length_within(const ConvexPolygon& polygon, const Vec3& normal, Vec3 from, Vec3 to);

/// The area; rounded.
double area_of(const Triangle3& triangle);
/// The normal of length 1; zero for a degenerate triangle.
Vec3 unit_normal(const Triangle3& triangle);
/// The smallest box.
Box3 box_of(const Triangle3& triangle);

/// The distance between a point and the nearest point of a triangle, which may be degenerate.
double distance(const Vec3& point, const Triangle3& triangle);

}  // namespace algebra3d
