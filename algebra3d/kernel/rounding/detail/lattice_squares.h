#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/cell_lattice.h"

namespace algebra3d {

/// Collects faces of the cells of a lattice as triangles. Any set of them is a valid surface: two share at most a whole
/// edge or a corner, if none is added twice.
class LatticeSquares {
 public:
  /// The lattice must outlive this.
  explicit LatticeSquares(const CellLattice& lattice) : lattice_(lattice) {}

  /// Adds the face of a cell that is perpendicular to an axis: the upper or the lower one. It looks away from the cell.
  void add(const CellLattice::Index& cell, std::size_t axis, bool is_upper);
  std::size_t count() const { return triangles_.size() / 2; }
  TriangleMesh mesh() &&;

 private:
  std::uint32_t vertex(const CellLattice::Index& lines);

  const CellLattice& lattice_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertices_;
  std::vector<Vec3> points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

}  // namespace algebra3d
