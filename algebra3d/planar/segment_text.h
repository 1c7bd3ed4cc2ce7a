#pragma once

#include <string>

#include "algebra3d/exact/point.h"

namespace algebra3d::planar {

/// `(0.5 2)`: whole numbers without a point, what is no double as `p/q`.
std::string corner_text(PointRef point);
/// `(0 0)-(2 2)`.
std::string segment_text(PointRef from, PointRef to);

}  // namespace algebra3d::planar
