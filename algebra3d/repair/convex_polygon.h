#pragma once

#include <array>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/vec3.h"

namespace algebra3d {

using Triangle3 = std::array<Vec3, 3>;

/// A convex polygon in space, its corners in order; empty if there are none. Rounded: for measures, never for decisions
/// on a solid.
struct ConvexPolygon {
  std::vector<Vec3> corners;

  bool is_empty() const { return corners.empty(); }
  double area() const;
  /// The mean of the corners: a point within.
  Vec3 middle() const;
  /// The triangles of the fan from the first corner.
  std::vector<Triangle3> triangles() const;
};

/// A plane by a point of it and its unit normal.
struct OrientedPlane {
  Vec3 point, normal;

  double height(const Vec3& p) const { return dot(p - point, normal); }
};

/// The parts of a polygon behind a plane and in front of it.
struct PlaneSplit {
  ConvexPolygon behind, before;
};

/// Divides the polygon at the plane, unless all of it lies on one side, or no farther than the noise beyond.
PlaneSplit split(const ConvexPolygon& polygon, const OrientedPlane& plane, double noise);

/// The length of the part of a segment that lies in the polygon, whose plane it lies in and whose unit normal is given.
double length_within(const ConvexPolygon& polygon, const Vec3& normal, Vec3 from, Vec3 to);

double area_of(const Triangle3& triangle);
/// The normal of length 1; zero for a triangle without area.
Vec3 unit_normal(const Triangle3& triangle);
Box3 box_of(const Triangle3& triangle);

/// From the point to the nearest one of the triangle, which may be degenerate.
double distance(const Vec3& point, const Triangle3& triangle);

}  // namespace algebra3d
