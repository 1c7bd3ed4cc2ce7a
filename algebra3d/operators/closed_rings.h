#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/planar/polygons.h"

namespace algebra3d {

/// Polygons from rings that repeat their first point at the end, as WKT and GeoJSON write them. A point that is given
/// several times directly one after the other is one corner.
class ClosedRings {
 public:
  /// Domain: finite numbers.
  void add_point(double x, double y);
  /// Errors: invalid_value for a ring whose last point is not its first; limit_exceeded.
  Status end_ring();
  /// Of the rings since the last face, the first is the outer one. A face without rings is none.
  void end_face();
  /// What has been ended.
  Polygons polygons() &&;

 private:
  std::vector<Vec3> corners_;
  std::vector<std::uint32_t> cycle_ends_, face_ends_;
};

}  // namespace algebra3d
