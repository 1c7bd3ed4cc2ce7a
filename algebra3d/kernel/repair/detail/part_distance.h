#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/repair/detail/unmatched_parts.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// The parts that are not proved to be within the tolerance of the mesh (SurfaceDistance::is_near). Errors:
/// interrupted. Cost: linear in the mesh, and a few searches per part.
Result<std::vector<SurfacePart>> far_parts(MeasureFrame& frame, const TriangleMesh& mesh,
                                           const std::vector<SurfacePart>& parts);

/// Sets `distance`, an upper bound of how far any point of the parts is from the mesh, and `where`, their farthest
/// point; both in coordinate units, while the parts are scaled.
void measure_distance(const MeasureFrame& frame, const TriangleMesh& mesh, const std::vector<SurfacePart>& parts,
                      SurfaceAmount& amount);

}  // namespace algebra3d
