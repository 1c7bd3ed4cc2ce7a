#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// Where a point lies relative to a closed set.
enum class Placement : std::uint8_t { outside, boundary, inside };

/// Where a point lies relative to a solid. Exact. Cost: that of a vertical ray through the box hierarchy; once many
/// points were located in this solid, constant for those away from its boundary (SolidCells).
Placement place_in_solid(PointRef point, const Geometry& solid);

/// Where each of many points lies relative to a solid, in parallel. Exact. Cost: as for one, for each.
std::vector<Placement> place_in_solid(std::span<const PointRef> points, const Geometry& solid);

/// Where a point lies relative to a solid of which all triangles are given that a vertical ray upwards from the point
/// meets. Exact. Cost: linear.
Placement place_by_faces_above(PointRef point, const TriangleMesh& faces);

/// Where a point lies relative to a surface: `inside` is on it and on no boundary edge. Exact. Cost: that of the
/// triangles whose boxes hold the point.
Placement place_on_surface(PointRef point, const Geometry& surface);

}  // namespace algebra3d
