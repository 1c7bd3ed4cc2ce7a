#include "algebra3d/values/display/detail/cluster_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "algebra3d/values/display/detail/task_size.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::detail {
namespace {

void find_cells(const ClusterGrid& grid, std::span<const Vec3> points, LargeVector<CellKey>& cells) {
  parallel_for(points.size(), kElementsPerTask, [&](std::size_t i) { cells[i] = grid.cell(points[i]); });
}

/// Triangles with corners in three cells.
std::size_t count_kept(std::span<const IndexTriangle> triangles, const LargeVector<CellKey>& cells) {
  std::vector<std::size_t> counts((triangles.size() + kElementsPerTask - 1) / kElementsPerTask);
  parallel_for(counts.size(), 1, [&](std::size_t task) {
    std::size_t count = 0;
    for (const auto& [a, b, c] : triangles.subspan(task * kElementsPerTask)
                                     .first(std::min(kElementsPerTask, triangles.size() - task * kElementsPerTask))) {
      const CellKey p = cells[a], q = cells[b], r = cells[c];
      count += static_cast<std::size_t>(p != q) & static_cast<std::size_t>(q != r) & static_cast<std::size_t>(r != p);
    }
    counts[task] = count;
  });
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

/// Searches the number of cells along the longest side between one that keeps few enough triangles and one that keeps
/// too many. The number of triangles grows with the square of that of the cells on a surface.
class GridSearch {
 public:
  explicit GridSearch(std::size_t max_triangles) : target_(static_cast<double>(max_triangles)) {
    next_ = std::clamp(std::sqrt(target_ / 6), few_, ClusterGrid::kMostCells);
  }

  double next() const { return next_; }
  double found() const { return few_; }
  bool is_done() const {
    constexpr double kCloseEnough = 0.93;
    return few_count_ >= kCloseEnough * target_ || many_ - few_ < 0.01 * few_ || few_ >= ClusterGrid::kMostCells;
  }
  void learn(std::size_t count) {
    const auto kept = static_cast<double>(count);
    (kept <= target_ ? few_ : many_) = next_;
    if (kept <= target_) few_count_ = kept;
    // Somewhat below the target, so that the guess is not just above it.
    const double guess = next_ * std::sqrt(0.97 * target_ / std::max(kept, 1.0));
    const double low = few_ + 0.02 * (many_ - few_), high = many_ - 0.02 * (many_ - few_);
    next_ = std::isinf(many_) ? std::min(std::clamp(guess, 1.1 * few_, 16 * few_), ClusterGrid::kMostCells)
                              : std::clamp(guess, low, high);
  }

 private:
  double target_;
  double few_ = 1, few_count_ = 0, many_ = Box3::kInfinity;
  double next_ = 1;
};

}  // namespace

ClusterGrid::ClusterGrid(const Box3& box, double cells) : origin_(box.min) {
  const Vec3 extent = box.max - box.min;
  const double largest = std::max({extent.x, extent.y, extent.z});
  // The last point is in the last cell, whatever is rounded.
  scale_ = largest > 0 ? cells * (1 - 0x1p-40) / largest : 0;
  size_ = largest / cells;
}

Box3 ClusterGrid::box_of(CellKey key) const {
  constexpr CellKey kLast = (CellKey{1} << 21U) - 1;
  const Vec3 place{static_cast<double>(key >> 42U), static_cast<double>(key >> 21U & kLast),
                   static_cast<double>(key & kLast)};
  return {origin_ + size_ * place, origin_ + size_ * (place + Vec3{1, 1, 1})};
}

Result<CellsOfPoints> choose_cells(const TrianglesView& fine, std::size_t max_triangles, const Monitor& monitor) {
  const Box3 box = Box3::around(fine.points);
  LargeVector<CellKey> cells(fine.points.size());
  GridSearch search(max_triangles);
  double last = 0;
  while (!search.is_done()) {
    A3D_TRY(monitor.check());
    last = search.next();
    find_cells(ClusterGrid(box, last), fine.points, cells);
    search.learn(count_kept(fine.triangles, cells));
  }
  ClusterGrid grid(box, search.found());
  if (last != search.found()) find_cells(grid, fine.points, cells);
  return CellsOfPoints{grid, std::move(cells)};
}

}  // namespace algebra3d::detail
