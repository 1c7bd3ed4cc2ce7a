#pragma once

#include <optional>
#include <string>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/planar/polygons.h"

namespace algebra3d {

/// Polygons that move and change their shape: corner i moves linearly from `start.corners[i]` at s = 0 to
/// `end.corners[i]` at s = 1. Both have the same cycles and faces.
struct MovingPolygons {
  Polygons start;
  Polygons end;

  friend bool operator==(const MovingPolygons&, const MovingPolygons&) = default;
};

/// The polygons at a time 0 <= s <= 1, with exact coordinates. Cost: linear.
Polygons at(const MovingPolygons& moving, const Rational& s);

/// The first defect that makes the polygons invalid (polygon_validity.h) at some time 0 < s < 1, or nothing. The
/// message names the moving segments, faces and cycles, counted from 1, and the time as a fraction of the unit. At s =
/// 0 and s = 1 polygons may be collapsed or overlap. Exact, also for irrational times. Errors: interrupted. Cost: n log
/// n for n segments; for each pair that comes near, a fraction of a microsecond if it stays clearly apart, else some
/// ten microseconds.
Result<std::optional<std::string>> moving_polygon_defect(const MovingPolygons& moving, const Monitor& monitor = {});

}  // namespace algebra3d
