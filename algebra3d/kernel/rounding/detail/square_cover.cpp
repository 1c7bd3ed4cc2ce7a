#include "algebra3d/kernel/rounding/detail/square_cover.h"

#include <cstdint>
#include <map>
#include <utility>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/rounding/detail/lattice_squares.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The upper face of a cell along an axis.
using Square = std::pair<std::uint64_t, std::size_t>;

PointRef centre_of(const CellLattice& lattice, const CellLattice::Index& cell) {
  const Box3 box = lattice.box({cell, cell});
  return Vec3{box.min.x / 2 + box.max.x / 2, box.min.y / 2 + box.max.y / 2, box.min.z / 2 + box.max.z / 2};
}

/// Squares between cells, and whether each looks up: as the first triangle that divides the centres.
class DividedCells {
 public:
  explicit DividedCells(const CellLattice& lattice) : lattice_(lattice) {}

  /// A cell, and a triangle that meets it or the next cell along an axis.
  void add(const CellLattice::Index& cell, std::size_t axis, const TriangleRef& triangle) {
    CellLattice::Index next = cell;
    ++next[axis];
    const PointRef from = centre_of(lattice_, cell), to = centre_of(lattice_, next);
    // Between neighbouring doubles there is no centre.
    if (equal(from, to) || intersect_segment_triangle(from, to, triangle) == Contact::none) return;
    const bool looks_up = orient3d(triangle[0], triangle[1], triangle[2], from) <= 0;
    squares_.try_emplace({CellKey::of(cell), axis}, looks_up);
  }

  bool is_empty() const { return squares_.empty(); }

  TriangleMesh mesh() const {
    LatticeSquares squares(lattice_);
    for (const auto& [square, looks_up] : squares_) {
      CellLattice::Index cell = CellKey::cell(square.first);
      if (!looks_up) ++cell[square.second];
      squares.add(cell, square.second, looks_up);
    }
    return std::move(squares).mesh();
  }

 private:
  const CellLattice& lattice_;
  std::map<Square, bool> squares_;
};

TriangleMesh lower_faces(const MetCells& met) {
  LatticeSquares squares(met.lattice);
  for (const std::uint64_t key : met.keys) squares.add(CellKey::cell(key), 2, false);
  return std::move(squares).mesh();
}

}  // namespace

Result<TriangleMesh> square_cover(const TriangleMesh& surface, const MetCells& met, const std::atomic<bool>* cancel) {
  const Monitor monitor(cancel);
  DividedCells divided(met.lattice);
  for (const FaceId face : faces(surface)) {
    A3D_TRY(monitor.check());
    const TriangleRef triangle = surface.corners(face);
    for (const std::uint64_t key : cells_of(triangle, met.lattice)) {
      const CellLattice::Index cell = CellKey::cell(key);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CellLattice::Index before = cell;
        --before[axis];
        if (cell[axis] > 0) divided.add(before, axis, triangle);
        if (cell[axis] + 1 < met.lattice.cell_count(axis)) divided.add(cell, axis, triangle);
      }
    }
  }
  return divided.is_empty() ? lower_faces(met) : divided.mesh();
}

}  // namespace algebra3d
