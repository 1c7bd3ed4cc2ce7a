#pragma once

#include "algebra3d/kernel/planar/polygons.h"

namespace algebra3d {

/// Twice the area of the polygons: per face that of its outer cycle less its holes, whatever their orientation; 0 only
/// without faces. Units: squared coordinate units. Domain: valid polygons (polygon_validity.h). Exact. Cost: linear;
/// see exact_doubled_area.
Rational doubled_area(const Polygons& valid);
/// The area, rounded once; infinite beyond the range of doubles.
double nearest_area(const Polygons& valid);
/// Length of all cycles, in coordinate units. Exactness: within 2 ulp. Cost: linear.
double nearest_perimeter(const Polygons& polygons);

}  // namespace algebra3d
