#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/detail/proved_parts.h"
#include "algebra3d/kernel/validity/report.h"

namespace algebra3d {

/// Per face: true if it is neither degenerate nor a duplicate of an earlier face.
using SoundFaces = std::vector<bool>;

/// Adds degenerate and duplicate triangles to `report` and returns the remaining faces for the later stages. Of n
/// triangles with the same corners n - 1 are duplicates. Known faces must not be degenerate or duplicates of each
/// other. Exact. Cost: linear; n log n where many share one edge.
SoundFaces check_triangles(const TriangleMesh& mesh, const ProvedParts& proved, ValidityReport& report);

}  // namespace algebra3d
