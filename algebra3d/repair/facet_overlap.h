#pragma once

#include <vector>

#include "algebra3d/repair/convex_polygon.h"

namespace algebra3d {

/// A facet that is compared with others, with what is asked of it often.
struct MeasuredFacet {
  Triangle3 corners;
  OrientedPlane plane;

  explicit MeasuredFacet(const Triangle3& triangle) : corners(triangle), plane{triangle[0], unit_normal(triangle)} {}
};

/// True if one of them lies in the plane of the other, but for the tolerance.
bool are_coplanar(const MeasuredFacet& a, const MeasuredFacet& b, double tolerance);

/// Takes what lies upon the cutter away from parts of a facet that is coplanar with it.
void subtract(std::vector<ConvexPolygon>& parts, const MeasuredFacet& facet, const MeasuredFacet& cutter,
              double tolerance);

/// Divides those parts of the facet at which the other one crosses or touches it along a line, at that line. Nothing is
/// divided once there are `most` parts.
void divide_at(std::vector<ConvexPolygon>& parts, const MeasuredFacet& facet, const MeasuredFacet& other,
               double tolerance, std::size_t most);

}  // namespace algebra3d
