#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The smallest box of doubles that holds a triangle.
Box3 box_of_triangle(const TriangleRef& corners);

}  // namespace algebra3d
