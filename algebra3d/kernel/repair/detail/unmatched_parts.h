#pragma once

#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/repair/detail/unmatched_triangles.h"

namespace algebra3d {

/// A part of an unmatched triangle, in scaled coordinates.
struct SurfacePart {
  UnmatchedId triangle;
  ConvexPolygon polygon;
};

/// The parts of the unmatched given triangles that the solid does not cover.
struct GivenParts {
  std::vector<SurfacePart> parts;           ///< cut where the solid crosses them
  double area_seen = 0;                     ///< of all given triangles, scaled; overlaps count once
  IdVector<UnmatchedId, bool> are_covered;  ///< whether unmatched faces of the solid cover at least a part of it
  std::vector<std::pair<UnmatchedId, UnmatchedId>> lies_upon;  ///< pairs of a triangle and an earlier one
};

/// Cuts the unmatched given triangles. Triangles count as coplanar within the tolerance. Rounded. Errors: interrupted.
/// Cost: that of the pairs whose boxes meet.
Result<GivenParts> parts_of_given(MeasureFrame& frame, const TriangleMatching& matching);

/// The parts of the solid's unmatched triangles that no given triangle covers.
Result<std::vector<SurfacePart>> parts_of_solid(MeasureFrame& frame, const TriangleMatching& matching);

}  // namespace algebra3d
