#pragma once

#include <vector>

#include "algebra3d/kernel/repair/detail/convex_polygon.h"

namespace algebra3d {

/// A triangle with its plane, precomputed for many comparisons.
struct MeasuredTriangle {
  Triangle3 corners;
  OrientedPlane plane;

  explicit MeasuredTriangle(const Triangle3& triangle) : corners(triangle), plane{triangle[0], unit_normal(triangle)} {}
};

/// True if one of the triangles lies in the plane of the other, within the tolerance. Coordinates and tolerance are
/// scaled, in this header.
bool are_coplanar(const MeasuredTriangle& a, const MeasuredTriangle& b, double tolerance);

/// Removes from the parts of a triangle the overlap with a coplanar cutter.
void subtract(std::vector<ConvexPolygon>& parts, const MeasuredTriangle& triangle, const MeasuredTriangle& cutter,
              double tolerance);

/// Divides the parts of a triangle at the line along which another triangle crosses or touches it, until there are
/// `most` parts.
void divide_at(std::vector<ConvexPolygon>& parts, const MeasuredTriangle& triangle, const MeasuredTriangle& other,
               double tolerance, std::size_t most);

}  // namespace algebra3d
