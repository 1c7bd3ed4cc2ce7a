#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/arrangement/upward_rays.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/cell_lattice.h"
#include "algebra3d/kernel/rounding/detail/met_cells.h"

namespace algebra3d {

/// The union of all cells that meet a valid solid. Cells that do not meet its boundary are inside or outside
/// altogether; those of one column between two that do form a run.
class CellCover {
 public:
  /// `at_boundary`: the cells that meet the triangles of the solid. Both must outlive this.
  CellCover(const TriangleMesh& solid, const MetCells& at_boundary);

  /// True if a cell lies within the solid and does not touch its boundary. Exact. Errors: interrupted.
  Result<bool> has_inner_cell(const std::atomic<bool>* cancel);
  /// The boundary: the squares between cells of the cover and others, each as two triangles. A valid volume by
  /// construction: each square is there at most once, it has the cover behind it, and two of them share at most a whole
  /// edge or a corner. It contains the solid, and each square belongs to a cell that meets its boundary. Errors:
  /// interrupted.
  Result<TriangleMesh> boundary(const std::atomic<bool>* cancel);

 private:
  enum class State : std::uint8_t { unknown, inside, outside };

  bool is_inside(const CellLattice::Index& cell);
  bool covers(const CellLattice::Index& cell);

  const CellLattice& lattice_;
  const std::vector<std::uint64_t>& keys_;  // of the cells at the boundary
  std::vector<State> state_after_;          // per key: of the run that follows it
  UpwardRays rays_;
};

}  // namespace algebra3d
