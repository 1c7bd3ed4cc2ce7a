#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/arrangement/detail/result_mesh.h"
#include "algebra3d/kernel/arrangement/detail/selection.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"

namespace algebra3d::arrangement {

/// Stage 9: the mesh of the selected sub-facets and patches. Selected sub-facets of one plane are joined to regions
/// (region_edges.h), pseudo-nodes left out (pseudo_nodes.h), and each region is triangulated anew (regions.h); selected
/// patches are taken over as they are (result_mesh.h). Exact. Errors: internal as triangulate_regions. Cost: n log n in
/// the sub-edges; linear in the faces taken over.
Result<TriangleMesh> build_result_mesh(const Subdivision& subdivision, Selection selection);
/// As above, for a subdivision that is not needed any more: frees sub-edges once the edges of regions are known, and
/// the rest before the mesh is linked.
Result<TriangleMesh> build_result_mesh(Subdivision&& subdivision, Selection selection);

}  // namespace algebra3d::arrangement
