#include "algebra3d/kernel/rounding/detail/met_cells.h"

#include <algorithm>
#include <utility>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/triangle_box.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Block = CellLattice::Block;

/// The most cells along an axis: with one or two more at the ends, keys have room for them.
constexpr double kMostCells = 0x1p20;

/// The halves of a block, across its longest axis.
std::pair<Block, Block> halves(const Block& block) {
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (block.last[axis] - block.first[axis] > block.last[longest] - block.first[longest]) longest = axis;
  std::pair<Block, Block> both{block, block};
  both.first.last[longest] = (block.first[longest] + block.last[longest]) / 2;
  both.second.first[longest] = both.first.last[longest] + 1;
  return both;
}

/// Calls visit(key) for each cell that meets a triangle, until it returns false.
template <typename Visit>
bool visit_cells(const TriangleRef& triangle, const CellLattice& lattice, Visit visit) {
  std::vector<Block> stack{lattice.cells_at(box_of_triangle(triangle))};
  while (!stack.empty()) {
    const Block block = stack.back();
    stack.pop_back();
    if (!meets_box(triangle, lattice.box(block))) continue;
    if (!block.is_one_cell()) {
      const auto [low, high] = halves(block);
      stack.push_back(low);
      stack.push_back(high);
    } else if (!visit(CellKey::of(block.first))) {
      return false;
    }
  }
  return true;
}

/// Keys, each once, as long as they are not too many.
class KeySet {
 public:
  explicit KeySet(std::size_t budget) : budget_(budget) {}

  /// False if there are too many.
  bool add(std::uint64_t key) {
    keys_.push_back(key);
    return keys_.size() < 4 * budget_ || is_within_budget();
  }
  /// Ascending; none if there are too many.
  std::optional<std::vector<std::uint64_t>> keys() && {
    if (!is_within_budget()) return std::nullopt;
    return std::move(keys_);
  }

 private:
  bool is_within_budget() {
    std::ranges::sort(keys_);
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    return keys_.size() <= budget_;
  }

  std::size_t budget_;
  std::vector<std::uint64_t> keys_;
};

/// The cells that meet the triangles, ascending; none if they are too many.
Result<std::optional<std::vector<std::uint64_t>>> cells_of(const TriangleMesh& mesh, const CellLattice& lattice,
                                                           std::size_t budget, const std::atomic<bool>* cancel) {
  KeySet keys(budget);
  const Monitor monitor(cancel);
  for (const FaceId face : faces(mesh)) {
    A3D_TRY(monitor.check());
    if (!visit_cells(mesh.corners(face), lattice, [&](std::uint64_t key) { return keys.add(key); }))
      return std::optional<std::vector<std::uint64_t>>();
  }
  return std::move(keys).keys();
}

double cells_along_longest_side(const Box3& bounds, double edge) {
  double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) most = std::max(most, bounds.max[axis] / edge - bounds.min[axis] / edge);
  return most;
}

/// The edge length of a lattice of a few cells over the bounds: a power of two times the smallest one.
double coarsest_edge(const Box3& bounds, double smallest) {
  double edge = smallest;
  while (cells_along_longest_side(bounds, edge) > 4) edge *= 2;
  return edge;
}

}  // namespace

std::vector<std::uint64_t> cells_of(const TriangleRef& triangle, const CellLattice& lattice) {
  std::vector<std::uint64_t> keys;
  visit_cells(triangle, lattice, [&](std::uint64_t key) {
    keys.push_back(key);
    return true;
  });
  return keys;
}

double smallest_cell(const TriangleMesh& mesh, const CoordinateGrid& grid) {
  const double size = largest_coordinate(mesh);
  // Where multiples are closer to each other than doubles, only powers of two times them are on both.
  double smallest = grid.spacing_up_to(size);
  while (smallest < CoordinateGrid::doubles().spacing_up_to(size)) smallest *= 2;
  return smallest;
}

Result<std::optional<MetCells>> finest_met_cells(const TriangleMesh& mesh, const CoordinateGrid& grid,
                                                 std::size_t budget, const std::atomic<bool>* cancel) {
  Box3 bounds;
  for (const FaceId face : faces(mesh)) bounds.extend(box_of_triangle(mesh.corners(face)));
  const double smallest = smallest_cell(mesh, grid);
  std::optional<MetCells> finest;
  double edge = coarsest_edge(bounds, smallest);
  while (edge >= smallest && cells_along_longest_side(bounds, edge) <= kMostCells) {
    CellLattice lattice(bounds, edge, grid);
    if (!lattice.covers(bounds)) break;
    A3D_ASSIGN(auto keys, cells_of(mesh, lattice, budget, cancel));
    if (!keys) break;
    finest = MetCells{std::move(lattice), *std::move(keys)};
    edge /= 2;
  }
  return finest;
}

}  // namespace algebra3d
