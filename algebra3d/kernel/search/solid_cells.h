#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A grid of equal cells over the box of a solid. A cell that no triangle reaches is inside or outside as a whole, so
/// that one look tells where its points lie. Immutable after construction; refers to nothing. Memory: a byte per cell.
///
/// The cell of a coordinate is a monotonic function of it (subtract, scale, round down), and a triangle reaches all
/// cells from that of the smallest to that of the largest coordinate of its box: so no rounding hides a triangle. Large
/// triangles leave out cells on one side of their plane, by a bound that covers all roundings.
class SolidCells {
 public:
  /// Whether each of some points, none of them on a triangle, is inside the solid.
  using AreInside = std::function<std::vector<bool>(std::span<const Vec3> points)>;

  /// The cells of the solid that `mesh` bounds, about `cell_count`; `box` is that of the mesh. Null if the box has no
  /// finite sizes, or if its triangles are so large that each reaches many cells. Cost: linear in cells and triangles;
  /// `are_inside` is asked once, for a point of each connected set of cells.
  static std::unique_ptr<const SolidCells> make(const TriangleMesh& mesh, const Box3& box, std::size_t cell_count,
                                                const AreInside& are_inside);

  /// Whether a point is inside the solid, and on no triangle; nothing if its cell does not tell.
  std::optional<bool> is_inside(const Vec3& point) const {
    if (!box_.contains(point)) return false;
    const State state = states_[cell_at({slice_of(point.x, 0), slice_of(point.y, 1), slice_of(point.z, 2)})];
    return state == State::reached ? std::nullopt : std::optional(state == State::inside);
  }

 private:
  enum class State : std::uint8_t { unvisited, reached, inside, outside };
  using Slices = std::array<std::uint32_t, 3>;  // of the grid, by axis
  struct Range {
    Slices first, last;
  };

  SolidCells(const Box3& box, std::size_t cell_count);
  std::size_t cell_count() const { return std::size_t{counts_[0]} * counts_[1] * counts_[2]; }
  std::uint32_t slice_of(double coordinate, std::size_t axis) const {
    const auto slice = static_cast<std::uint32_t>((coordinate - box_.min[axis]) * scale_[axis]);
    return slice < counts_[axis] ? slice : counts_[axis] - 1;
  }
  std::size_t cell_at(const Slices& slices) const {
    return (std::size_t{slices[2]} * counts_[1] + slices[1]) * counts_[0] + slices[0];
  }
  /// The middle of a cell; it lies in another cell if cells are as small as the spacing of doubles.
  Vec3 middle_of(const Slices& slices) const;
  Range range_of(const Box3& box) const;
  bool mark_reached(const TriangleMesh& mesh);
  void mark_reached_by(const TriangleRef& corners, const Range& range);
  /// Gives all cells that are connected with one, across reached ones nowhere, a state.
  void spread(const Slices& from, State state, std::vector<Slices>& stack);

  Box3 box_;
  Vec3 scale_;  ///< slices per unit
  Slices counts_{};
  std::vector<State> states_;
};

}  // namespace algebra3d
