#pragma once

#include <atomic>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/met_cells.h"

namespace algebra3d {

/// A surface of faces of the cells of a lattice that follows a valid surface: the squares between cells whose centres
/// the surface divides, oriented as it; if there are none, the lower faces of all cells that it meets. Never empty. A
/// valid surface by construction; each square belongs to a cell that meets the given surface. `met`: the cells that
/// meet the surface. Errors: interrupted. Cost: as met_cells.
Result<TriangleMesh> square_cover(const TriangleMesh& surface, const MetCells& met, const std::atomic<bool>* cancel);

}  // namespace algebra3d
