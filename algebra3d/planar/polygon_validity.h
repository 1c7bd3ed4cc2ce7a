#pragma once

#include <optional>
#include <string>

#include "algebra3d/base/monitor.h"
#include "algebra3d/planar/polygons.h"

namespace algebra3d {

/// The first reason why the polygons bound no region, with coordinates, and faces and cycles counted from 1; nothing if
/// they do. They do if
///  - every cycle has three corners at least and is simple: its segments have a length, and meet in nothing but the
///    common ends of neighbours;
///  - segments of different cycles neither cross nor overlap; they may touch in points;
///  - every hole lies inside the outer cycle of its face, and in no other hole of it;
///  - faces have no inner points in common; one may lie in a hole of another.
/// Sense of rotation and order are free. Domain: `cycle_ends` and `face_ends` ascend and end with the numbers of
/// corners and cycles. Exact. Errors: interrupted. Cost: as `constrained_delaunay`, in which the segments are looked at
/// one after the other.
Result<std::optional<std::string>> polygon_defect(const Polygons& polygons, const Monitor& monitor = {});

/// The same with outer cycles counter-clockwise and holes clockwise; the first corner of a cycle stays the first.
/// Domain: simple cycles. Exact. Cost: linear.
Polygons oriented(const Polygons& polygons);

}  // namespace algebra3d
