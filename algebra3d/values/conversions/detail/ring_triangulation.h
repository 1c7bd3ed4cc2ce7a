#pragma once

#include <span>
#include <vector>

#include "algebra3d/kernel/exact/point_table.h"
#include "base/indices.h"

namespace algebra3d {

/// A closed polygon of points, by their numbers.
using PointRing = std::vector<IndexTriangle::value_type>;

/// Triangulates a polygon in space with holes, in the projection along the axis nearest to the normal of its first
/// ring, which is the outer one, or else along another axis. Rings are numbers of points; they may touch in points, and
/// holes may have either orientation. Appends triangles over the same points, with the orientation of the outer ring,
/// each edge of a ring in one of them; so a flat polygon is triangulated in its plane. False, with nothing appended, if
/// the rings bound no polygon in any projection. Exact but for the choice of the axis and the orientation of holes.
/// Cost: n log n.
[[nodiscard]] bool triangulate_rings(const PointTable& points, std::span<const PointRing> rings,
                                     std::vector<IndexTriangle>& triangles);

}  // namespace algebra3d
