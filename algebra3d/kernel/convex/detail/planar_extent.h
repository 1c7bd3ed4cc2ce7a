#pragma once

#include <array>
#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d::detail {

/// A point of a plane, in doubles.
struct PlanePoint {
  double x = 0, y = 0;
};

/// The convex hull of points of a plane, counter-clockwise, rounded. Cost: n log n.
std::vector<PlanePoint> planar_hull(std::vector<PlanePoint> points);

/// The rectangle of the smallest area around a convex polygon: the direction of one side, and its area. One side lies
/// on an edge of the polygon. Source: [freeman1975]. Cost: quadratic in the corners.
struct PlaneRectangle {
  PlanePoint direction{1, 0};  ///< a unit vector
  double area = 0;
};
PlaneRectangle smallest_rectangle(std::span<const PlanePoint> hull);

/// The largest distance of two points. Cost: quadratic.
double diameter(std::span<const PlanePoint> hull);

/// The smallest circle around points, rounded.
struct PlaneCircle {
  PlanePoint centre;
  double radius = 0;
};
PlaneCircle smallest_circle(std::span<const PlanePoint> points);

}  // namespace algebra3d::detail
