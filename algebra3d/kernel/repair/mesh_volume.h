#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/amount.h"

namespace algebra3d {

/// The volume that a closed mesh encloses, rounded once; infinite beyond the range of doubles. Errors: interrupted.
/// Cost: that of exact_volume.
Result<double> nearest_volume(const TriangleMesh& mesh, const Monitor& monitor = {});
/// The volume that a closed mesh encloses as an Amount, which has no largest value.
Result<Amount> measured_volume(const TriangleMesh& mesh, const Monitor& monitor = {});

}  // namespace algebra3d
