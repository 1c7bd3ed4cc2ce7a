#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/cell_lattice.h"

namespace algebra3d {

/// The cells of a lattice that meet a triangle, as keys, each once. Cells are closed, so those that are touched count.
/// The lattice must cover the triangle, and have fewer than 2^21 cells per axis. Exact. Cost: some microseconds per
/// cell.
std::vector<std::uint64_t> cells_of(const TriangleRef& triangle, const CellLattice& lattice);

/// A lattice and the cells that meet the triangles of a mesh.
struct MetCells {
  CellLattice lattice;
  std::vector<std::uint64_t> keys;  ///< ascending
};

/// How many cells may replace a mesh: as many as it has triangles, from 50,000 to 500,000.
inline std::size_t cell_budget(const TriangleMesh& mesh) {
  return std::clamp<std::size_t>(mesh.face_count(), 50'000, 500'000);
}

/// The edge length of the smallest cells of a lattice over a mesh: the spacing of the grid there.
double smallest_cell(const TriangleMesh& mesh, const CoordinateGrid& grid);

/// The finest lattice of which at most `budget` cells meet the triangles of a mesh, and that has at most 2^20 cells
/// along an axis. Its edges are a power of two times
/// the spacing of the grid, and at least that. None if the mesh reaches beyond the largest number of the grid.
/// `budget`: from 1000 to 2^19. Deterministic. Errors: interrupted. Cost: a few times that of the cells of all
/// triangles.
Result<std::optional<MetCells>> finest_met_cells(const TriangleMesh& mesh, const CoordinateGrid& grid,
                                                 std::size_t budget, const std::atomic<bool>* cancel);

}  // namespace algebra3d
