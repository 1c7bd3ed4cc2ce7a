#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The smallest box of doubles around a triangle.
Box3 box_of_triangle(const TriangleRef& corners);

/// The box with its sides moved outward by a length each, outward-rounded.
Box3 padded(const Box3& box, double by);

/// The largest absolute value of a coordinate of the points of a mesh, unused points included; 0 without points.
/// Rounded where points are exact. Cost: linear.
double largest_coordinate(const TriangleMesh& mesh);

}  // namespace algebra3d
