#pragma once

#include <cstddef>

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// Twice the area of the polygon with the corners begin to end - 1 in the plane z = 0; positive if it turns
/// counter-clockwise. Units: squared coordinate units. Domain: any points. Exact. Cost: linear; per point tens of
/// nanoseconds where the coordinates are less than 124 bits apart, more beyond, microseconds at points that are not
/// doubles.
Rational exact_doubled_area(const PointArray& points, std::size_t begin, std::size_t end);

/// Perimeter of the same polygon. Exactness: within 1 ulp; infinite beyond the range of doubles. Cost: linear, tens of
/// nanoseconds per point, microseconds at points that are not doubles. Source: [dekker1971] for the arithmetic with
/// rests.
double nearest_length(const PointArray& points, std::size_t begin, std::size_t end);

}  // namespace algebra3d
