#include "algebra3d/values/display/vertex_clustering.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/values/display/detail/cell_numbers.h"
#include "algebra3d/values/display/detail/task_size.h"
#include "base/interruption_scope.h"
#include "base/large_allocator.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

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

void find_cells(const ClusterGrid& grid, std::span<const Vec3> points, LargeVector<CellKey>& cells) {
  parallel_for(points.size(), detail::kElementsPerTask, [&](std::size_t i) { cells[i] = grid.cell(points[i]); });
}

/// Triangles with corners in three cells.
std::size_t count_kept(std::span<const IndexTriangle> triangles, const LargeVector<CellKey>& cells) {
  std::vector<std::size_t> counts((triangles.size() + detail::kElementsPerTask - 1) / detail::kElementsPerTask);
  parallel_for(counts.size(), 1, [&](std::size_t task) {
    std::size_t count = 0;
    for (const auto& [a, b, c] :
         triangles.subspan(task * detail::kElementsPerTask)
             .first(std::min(detail::kElementsPerTask, triangles.size() - task * detail::kElementsPerTask))) {
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

/// The plane of a triangle, weighted by its area.
ClusterSums plane_sums(const Vec3& p, const Vec3& q, const Vec3& r) {
  ClusterSums sums;
  const Vec3 doubled_area = cross(q - p, r - p);
  const double size = std::sqrt(dot(doubled_area, doubled_area));
  if (!(size > 0)) return sums;
  const Vec3 n = 1 / size * doubled_area, weighted = size * n;
  sums.a = {weighted.x * n.x, weighted.x * n.y, weighted.x * n.z, weighted.y * n.y, weighted.y * n.z, weighted.z * n.z};
  sums.b = dot(n, p) * weighted;
  return sums;
}

/// The numbers of the clusters, per point; those of points without triangles are kNone.
struct Clusters {
  std::vector<std::uint32_t> of_point;
  std::vector<CellKey> cells;  // per cluster
};

Clusters number_clusters(const TrianglesView& fine, const LargeVector<CellKey>& cells, std::size_t expected) {
  std::vector<bool> is_used(fine.points.size());
  for (const IndexTriangle& triangle : fine.triangles)
    for (const std::uint32_t corner : triangle) is_used[corner] = true;
  detail::KeyNumbers numbers(expected);
  Clusters clusters;
  clusters.of_point.resize(fine.points.size(), kNone);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (is_used[i]) clusters.of_point[i] = numbers(cells[i]);
  clusters.cells = numbers.keys();
  return clusters;
}

/// The sums of some clusters.
struct PartialSums {
  std::vector<std::uint32_t> clusters;
  std::vector<ClusterSums> sums;
};

/// The planes of a range of original triangles, added to the clusters of their corners.
PartialSums sums_of_range(const TrianglesView& fine, const Clusters& clusters, std::size_t begin, std::size_t end) {
  PartialSums part;
  std::vector<std::uint32_t> places(clusters.cells.size(), kNone);
  const auto sums_of = [&](std::uint32_t point) -> ClusterSums& {
    const std::uint32_t cluster = clusters.of_point[point];
    if (places[cluster] == kNone) {
      places[cluster] = static_cast<std::uint32_t>(part.clusters.size());
      part.clusters.push_back(cluster);
      part.sums.emplace_back();
    }
    return part.sums[places[cluster]];
  };
  for (std::size_t i = begin; i < end; ++i) {
    const auto& [a, b, c] = fine.triangles[i];
    const ClusterSums plane = plane_sums(fine.points[a], fine.points[b], fine.points[c]);
    for (const std::uint32_t corner : {a, b, c}) sums_of(corner) += plane;
  }
  return part;
}

/// The sums of the clusters of original triangles. The ranges do not depend on the number of threads, so neither does
/// what is rounded.
std::vector<ClusterSums> sums_of_originals(const TrianglesView& fine, const Clusters& clusters) {
  constexpr std::size_t kRanges = 16;
  std::vector<PartialSums> parts(fine.triangles.size() < detail::kElementsPerTask ? 1 : kRanges);
  parallel_for(parts.size(), 1, [&](std::size_t i) {
    parts[i] = sums_of_range(fine, clusters, i * fine.triangles.size() / parts.size(),
                             (i + 1) * fine.triangles.size() / parts.size());
  });
  std::vector<ClusterSums> sums(clusters.cells.size());
  for (const PartialSums& part : parts)
    for (std::size_t i = 0; i < part.clusters.size(); ++i) sums[part.clusters[i]] += part.sums[i];
  for (std::size_t i = 0; i < fine.points.size(); ++i) {
    poll_interruption_at(i);
    if (clusters.of_point[i] == kNone) continue;
    ClusterSums& cluster = sums[clusters.of_point[i]];
    cluster.positions = cluster.positions + fine.points[i];
    cluster.count += 1;
  }
  return sums;
}

std::vector<ClusterSums> sums_of_level(const TrianglesView& fine, const Clusters& clusters) {
  std::vector<ClusterSums> sums(clusters.cells.size());
  for (std::size_t i = 0; i < fine.points.size(); ++i)
    if (clusters.of_point[i] != kNone) sums[clusters.of_point[i]] += fine.sums[i];
  return sums;
}

/// The least point of the sum of squares, held by a weak spring at the mean.
Vec3 place_of(const ClusterSums& sums) {
  const Vec3 mean = 1 / sums.count * sums.positions;
  const auto& [xx, xy, xz, yy, yz, zz] = sums.a;
  constexpr double kSpring = 1e-3;
  const double spring = kSpring * (xx + yy + zz);
  if (!(spring > 0)) return mean;
  // (A + spring) d = b - A mean, for the way d from the mean. By Cholesky's decomposition; the matrix is positive.
  const Vec3 pull = sums.b - Vec3{xx * mean.x + xy * mean.y + xz * mean.z, xy * mean.x + yy * mean.y + yz * mean.z,
                                  xz * mean.x + yz * mean.y + zz * mean.z};
  const double a = xx + spring, l1 = xy / a, l2 = xz / a;
  const double b = yy + spring - l1 * xy, m = yz - l1 * xz, l3 = m / b;
  const double c = zz + spring - l2 * xz - l3 * m;
  const double y = pull.y - l1 * pull.x, z = (pull.z - l2 * pull.x - l3 * y) / c;
  const double v = y / b - l3 * z;
  return mean + Vec3{pull.x / a - l1 * v - l2 * z, v, z};
}

Vec3 moved_into(const Box3& box, const Vec3& point) {
  Vec3 inside;
  for (std::size_t axis = 0; axis < 3; ++axis) inside[axis] = std::clamp(point[axis], box.min[axis], box.max[axis]);
  return inside;
}

std::vector<double> distances_moved(const TrianglesView& fine, const ClusteredTriangles& coarse) {
  std::vector<double> moved(coarse.points.size());
  for (std::size_t i = 0; i < fine.points.size(); ++i) {
    poll_interruption_at(i);
    const std::uint32_t cluster = coarse.point_of[i];
    if (cluster == kNone) continue;
    const Vec3 way = fine.points[i] - coarse.points[cluster];
    const double before = fine.moved.empty() ? 0 : fine.moved[i];
    moved[cluster] = std::max(moved[cluster], before + std::sqrt(dot(way, way)));
  }
  return moved;
}

/// The triangles that do not collapse, with their smallest corner first.
std::vector<IndexTriangle> kept_triangles(const TrianglesView& fine, const std::vector<std::uint32_t>& of_point) {
  return parallel_collect(fine.triangles.size(), detail::kElementsPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<IndexTriangle> kept;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [p, q, r] = fine.triangles[i];
      const std::uint32_t a = of_point[p], b = of_point[q], c = of_point[r];
      if (a == b || b == c || c == a) continue;
      kept.push_back(a < b && a < c ? IndexTriangle{a, b, c} : b < c ? IndexTriangle{b, c, a} : IndexTriangle{c, a, b});
    }
    return kept;
  });
}

/// Drops triangles that are there already.
void drop_repetitions(std::vector<IndexTriangle>& triangles) {
  // A pair of corners has a number, and that with the third corner another one.
  detail::KeyNumbers pairs(triangles.size()), numbers(triangles.size());
  std::size_t kept = 0;
  for (const IndexTriangle& triangle : triangles) {
    const std::uint32_t pair = pairs(std::uint64_t{triangle[0]} << 32U | triangle[1]);
    if (numbers(std::uint64_t{pair} << 32U | triangle[2]) == kept) triangles[kept++] = triangle;
  }
  triangles.resize(kept);
}

}  // namespace

ClusterSums& ClusterSums::operator+=(const ClusterSums& other) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += other.a[i];
  b = b + other.b;
  positions = positions + other.positions;
  count += other.count;
  return *this;
}

double ClusteredTriangles::deviation() const {
  return moved.empty() ? 0 : std::ranges::max(moved);
}

Result<ClusteredTriangles> clustered(const TrianglesView& fine, std::size_t max_triangles, const Monitor& monitor) {
  A3D_ASSIGN(const CellsOfPoints chosen, choose_cells(fine, max_triangles, monitor));
  Clusters clusters = number_clusters(fine, chosen.cells, max_triangles / 2);
  A3D_TRY(monitor.check());
  ClusteredTriangles coarse;
  coarse.sums = fine.sums.empty() ? sums_of_originals(fine, clusters) : sums_of_level(fine, clusters);
  A3D_TRY(monitor.check());
  coarse.points.resize(coarse.sums.size());
  parallel_for(coarse.points.size(), detail::kElementsPerTask, [&](std::size_t i) {
    coarse.points[i] = moved_into(chosen.grid.box_of(clusters.cells[i]), place_of(coarse.sums[i]));
  });
  coarse.point_of = std::move(clusters.of_point);
  coarse.moved = distances_moved(fine, coarse);
  coarse.triangles = kept_triangles(fine, coarse.point_of);
  A3D_TRY(monitor.check());
  drop_repetitions(coarse.triangles);
  return coarse;
}

}  // namespace algebra3d
