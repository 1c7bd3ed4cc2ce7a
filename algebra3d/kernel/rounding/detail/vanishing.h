#pragma once

#include <atomic>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"

namespace algebra3d {

/// True if a cell of the grid, or of a coarser one, is found that lies within a solid and does not touch its boundary:
/// then the solid must not vanish. `depth`, in coordinate units: no point of the solid is farther from its boundary, as
/// is known where moving the boundary so far left nothing; cells of more than twice that are not looked for. Of the
/// others, those of the 16 largest bodies are looked for among up to 10,000 at the boundary of each. Exact, where it
/// finds one. Deterministic. Errors: interrupted. Cost: linear if all facets are longer or larger than so many cells,
/// or the bodies thinner than one; else a few microseconds for each cell.
Result<bool> has_inner_cell(const TriangleMesh& solid, const CoordinateGrid& grid, double depth,
                            const std::atomic<bool>* cancel);

}  // namespace algebra3d
