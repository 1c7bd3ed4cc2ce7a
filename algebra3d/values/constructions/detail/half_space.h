#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The side of the plane on which a box lies: 1 in front (or touching), -1 behind, 0 both. Exact.
int side_of(const Box3& box, const ExactPlane& plane);

/// The largest magnitude of coordinates for which a box can be enlarged within the range of doubles.
inline constexpr double kMaxBoxCoordinate = 0x1p1000;

/// A prism that contains the part of the box behind the plane and nothing in front of it. One face lies exactly in the
/// plane, with the same front. Domain: the plane cuts the box (side_of is 0); coordinates of the box are at most eight
/// times kMaxBoxCoordinate.
TriangleMesh half_space_within(const Box3& box, const ExactPlane& plane);

/// The box as a solid. Domain: a box with positive volume.
TriangleMesh solid_of(const Box3& box);

}  // namespace algebra3d
