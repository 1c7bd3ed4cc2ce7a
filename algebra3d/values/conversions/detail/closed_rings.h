#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/planar/polygons.h"

namespace algebra3d {

/// Builds polygons from rings that repeat their first point at the end, as in WKT and GeoJSON. Adjacent equal points
/// become one corner.
class ClosedRings {
 public:
  /// Adds a point with finite coordinates.
  void add_point(double x, double y);
  /// Ends a ring. Errors: invalid_value if its last point is not its first; limit_exceeded.
  Status end_ring();
  /// Makes a face of the rings since the last face; the first is the outer one. Without rings it does nothing.
  void end_face();
  /// The ended faces.
  Polygons polygons() &&;

 private:
  std::vector<Vec3> corners_;
  std::vector<std::uint32_t> cycle_ends_, face_ends_;
};

}  // namespace algebra3d
