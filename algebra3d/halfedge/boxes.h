#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A box of doubles around a point: not always the smallest one, but made from the rounded coordinates alone.
Box3 box_of_point(const PointRef& point);
/// The same around a triangle.
Box3 box_of_triangle(const TriangleRef& corners);

}  // namespace algebra3d
