#pragma once

#include <cstddef>

#include "algebra3d/exact/point.h"

namespace algebra3d {

/// Twice the area that the points begin to end - 1 enclose in the plane z = 0, in this order and back to the first;
/// positive if they turn counter-clockwise. Units: squared coordinate units. Domain: any points. Exact.
/// Cost: linear; per point tens of nanoseconds where the coordinates are less than 124 bits apart, more beyond,
/// microseconds at points that are no doubles.
Rational exact_doubled_area(const PointArray& points, std::size_t begin, std::size_t end);

/// Length of the closed line through the same points. Exactness: within 1 ulp; infinite beyond the range of doubles.
/// Cost: linear, tens of nanoseconds per point, microseconds at points that are no doubles.
/// Source: [dekker1971] for the arithmetic with rests.
double nearest_length(const PointArray& points, std::size_t begin, std::size_t end);

}  // namespace algebra3d
