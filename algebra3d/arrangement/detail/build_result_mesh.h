#pragma once

#include "algebra3d/arrangement/detail/result_mesh.h"
#include "algebra3d/arrangement/detail/selection.h"
#include "algebra3d/arrangement/detail/subdivision.h"
#include "algebra3d/base/error.h"

namespace algebra3d::arrangement {

/// Stage 9: the mesh of what is selected, unlinked. Selected sub-facets of one plane are joined to regions
/// (region_edges.h), pseudo-nodes left out (pseudo_nodes.h), and each region is triangulated anew (regions.h); selected
/// patches are taken over as they are (result_mesh.h). Exact. Errors: internal as triangulate_regions. Cost: n log n in
/// the sub-edges; linear in the faces taken over.
Result<UnlinkedMesh> build_unlinked_mesh(const Subdivision& subdivision, const Selection& selection);

/// Links the mesh, and audits it in builds that audit stages. Cost: linear.
Result<TriangleMesh> linked_and_audited(UnlinkedMesh mesh);

/// Both.
Result<TriangleMesh> build_result_mesh(const Subdivision& subdivision, const Selection& selection);

}  // namespace algebra3d::arrangement
