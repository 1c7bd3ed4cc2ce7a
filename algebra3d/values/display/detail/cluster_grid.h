#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/display/vertex_clustering.h"
#include "base/large_allocator.h"

namespace algebra3d::detail {

/// The number of a cell: 21 bits for each axis.
using CellKey = std::uint64_t;

/// A grid of cubes over a box.
class ClusterGrid {
 public:
  static constexpr double kMostCells = 2097151;  // along an axis

  /// `cells` of them, perhaps a fraction, along the longest side of the box; from 1 to kMostCells.
  ClusterGrid(const Box3& box, double cells);

  CellKey cell(const Vec3& point) const {
    CellKey key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      key = key << 21U | static_cast<CellKey>((point[axis] - origin_[axis]) * scale_);
    return key;
  }
  Box3 box_of(CellKey key) const;

 private:
  Vec3 origin_;
  double scale_ = 0, size_ = 0;
};

/// The cells of all points in the finest grid that keeps at most `max_triangles` with corners in three cells, up to
/// some percent. Errors: interrupted. Cost: some passes over the triangles.
struct CellsOfPoints {
  ClusterGrid grid;
  LargeVector<CellKey> cells;  // per point
};
Result<CellsOfPoints> choose_cells(const TrianglesView& fine, std::size_t max_triangles, const Monitor& monitor);

}  // namespace algebra3d::detail
