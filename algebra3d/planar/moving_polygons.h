#pragma once

#include <optional>
#include <string>

#include "algebra3d/base/monitor.h"
#include "algebra3d/exact/rational.h"
#include "algebra3d/planar/polygons.h"

namespace algebra3d {

/// Polygons that move and change their shape: corner i goes evenly from `start.corners[i]` at s = 0 to
/// `end.corners[i]` at s = 1. Both have the same cycles and faces.
struct MovingPolygons {
  Polygons start;
  Polygons end;

  friend bool operator==(const MovingPolygons&, const MovingPolygons&) = default;
};

/// The polygons at a time 0 <= s <= 1, with exact coordinates. Cost: linear.
Polygons at(const MovingPolygons& moving, const Rational& s);

/// Why the polygons are not valid at every time 0 < s < 1 (polygon_validity.h says what that means at one time), or
/// nothing. The message names the moving segments, faces and cycles from 1, and when it happens as a part of the unit.
/// At s = 0 and s = 1 anything is allowed: what has collapsed there, or lies on something else, opens or closes.
/// Exactness: exact, also where it happens at an irrational time alone. Errors: interrupted.
/// Cost: segments n log n, and for each pair of segments that come near each other a fraction of a microsecond if they
/// stay clearly apart, else some ten microseconds.
Result<std::optional<std::string>> moving_polygon_defect(const MovingPolygons& moving, const Monitor& monitor = {});

}  // namespace algebra3d
