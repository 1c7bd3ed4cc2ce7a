#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/exact/plane.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// On which side of the plane a box lies: 1 wholly in front (or touching), -1 wholly behind, 0 on both. Exact.
int side_of(const Box3& box, const ExactPlane& plane);

/// The largest magnitude of coordinates for which there is room round a box.
inline constexpr double kLargestWithRoom = 0x1p1000;

/// A solid that holds all of the box behind the plane and nothing in front of it: a prism with one face in the plane,
/// whose front is that of the plane. The plane cuts the box (side_of is 0), whose coordinates are at most eight times
/// kLargestWithRoom. The corners of the prism are exact, so this face lies exactly in the plane.
TriangleMesh half_space_within(const Box3& box, const ExactPlane& plane);

/// The box as a solid; it is not flat.
TriangleMesh solid_of(const Box3& box);

}  // namespace algebra3d
