#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d::arrangement {

/// Box of doubles around a triangle, rounded outward.
Box3 box_of_triangle(const TriangleRef& corners);
/// Box of doubles around all triangles of a mesh, rounded outward. Cost: linear.
Box3 box_of_mesh(const TriangleMesh& mesh);

}  // namespace algebra3d::arrangement
