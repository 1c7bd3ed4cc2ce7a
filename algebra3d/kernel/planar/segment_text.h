#pragma once

#include <string>

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d::planar {

/// The text of a corner, `(0.5 2)`: whole numbers without a point, fractions that are not doubles as `p/q`.
std::string corner_text(PointRef point);
/// The text of a segment, `(0 0)-(2 2)`.
std::string segment_text(PointRef from, PointRef to);

}  // namespace algebra3d::planar
