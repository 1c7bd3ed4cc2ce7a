#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/repair_options.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Removes the shells of a valid volume that the options exclude: cavities, unless they are kept, and shells below the
/// smallest volume. A body in a filled cavity becomes part of the body around it. Exact. Errors: interrupted. Cost:
/// linear, and a union if a shell is removed.
Result<TriangleMesh> filter_shells(TriangleMesh solid, const RepairOptions& options, RepairReport& report,
                                   const Monitor& monitor = {});

}  // namespace algebra3d
