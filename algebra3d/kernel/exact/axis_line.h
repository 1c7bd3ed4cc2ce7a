#pragma once

#include <cstddef>

#include "algebra3d/kernel/exact/vertical_line.h"

namespace algebra3d {

/// Crosses a triangle with the line through p along an axis (0: x, 1: y, 2: z), as cross_vertical_line does along z:
/// what it says of x, y and z holds here for the three axes in cyclic order, of which this is the last.
LineCrossing cross_axis_line(std::size_t axis, PointRef p, const TriangleRef& triangle);

}  // namespace algebra3d
