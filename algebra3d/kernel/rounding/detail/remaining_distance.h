#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"

namespace algebra3d {

/// A bound of how far points of a rounded mesh are from the given one, in coordinate units; at most `known`, which is
/// such a bound, too. For meshes of which a part vanished: `known` may be the distance by which that part moved. Faces
/// that are given faces with rounded corners are as far as these moved; others are measured (covering_bound.h), unless
/// that takes too many pieces. `rounded` has double coordinates. Errors: interrupted. Cost: n log n, and some
/// microseconds for each face that is measured, a fraction of a second at most.
Result<double> remaining_distance(const TriangleMesh& given, const TriangleMesh& rounded, const CoordinateGrid& grid,
                                  double known, const Monitor& monitor);

}  // namespace algebra3d
