#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/repair_options.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// The valid volume without cavities, if they are not to be kept, and without shells that hold less volume than they
/// must. A body that lies in a cavity that is filled goes with it. Exact. Errors: interrupted.
/// Cost: linear, and a union of what is left if a cavity goes.
Result<TriangleMesh> kept_shells(TriangleMesh solid, const RepairOptions& options, RepairReport& report,
                                 const Monitor& monitor = {});

/// The volume that a closed mesh encloses, rounded once; infinite beyond the range of doubles. Errors: interrupted.
/// Cost: that of exact_volume.
Result<double> nearest_volume(const TriangleMesh& mesh, const Monitor& monitor = {});
/// The same, of any size.
Result<Amount> measured_volume(const TriangleMesh& mesh, const Monitor& monitor = {});

}  // namespace algebra3d
