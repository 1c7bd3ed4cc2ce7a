#pragma once

#include <optional>
#include <string>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/planar/polygons.h"

namespace algebra3d {

/// The first defect of polygons, with coordinates, and faces and cycles counted from 1; nothing if they bound a region,
/// that is, if
///  - every cycle has at least three corners and is simple: its segments have positive length, and meet only in the
///    common ends of neighbours;
///  - segments of different cycles neither cross nor overlap; they may touch in points;
///  - every hole lies inside the outer cycle of its face and outside its other holes;
///  - faces have no inner points in common; one may lie in a hole of another.
/// Orientation and order are free. Domain: `cycle_ends` and `face_ends` ascend and end with the numbers of corners and
/// cycles. Exact. Errors: interrupted. Cost: as `constrained_delaunay`, in which the segments are looked at one after
/// the other.
Result<std::optional<std::string>> polygon_defect(const Polygons& polygons, const Monitor& monitor = {});

/// Orients polygons: outer cycles counter-clockwise, holes clockwise; the first corner of a cycle stays the first.
/// Domain: simple cycles. Exact. Cost: linear.
Polygons oriented(const Polygons& polygons);

}  // namespace algebra3d
