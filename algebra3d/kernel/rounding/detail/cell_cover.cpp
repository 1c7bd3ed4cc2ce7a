#include "algebra3d/kernel/rounding/detail/cell_cover.h"

#include <algorithm>
#include <utility>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/rounding/detail/lattice_squares.h"
#include "base/propagate.h"

namespace algebra3d {

CellCover::CellCover(const TriangleMesh& solid, const MetCells& at_boundary)
    : lattice_(at_boundary.lattice), keys_(at_boundary.keys), state_after_(keys_.size()), rays_(solid) {}

/// A cell that does not meet the boundary: by the first triangle above any of its points. Two triangles may be hit at
/// one height where bodies touch in an edge; then another point is asked, of points no three of which are on a line.
bool CellCover::is_inside(const CellLattice::Index& cell) {
  const Box3 box = lattice_.box({cell, cell});
  const RationalVec3 low(box.min), high(box.max);
  const auto between = [&](std::size_t axis, const Rational& share) {
    return low[axis] + share * (high[axis] - low[axis]);
  };
  bool is_found = false, is_inside = false;
  for (int n = 2; !is_found; ++n) {
    const Rational share = Rational(1) / Rational(n);
    const ExactPoint point(RationalVec3(between(0, share), between(1, share * share), low.z));
    is_found = rays_.for_each(point, [&](FaceId /*face*/, bool looks_up) {
      is_inside = looks_up;
      return false;
    });
  }
  return is_inside;
}

bool CellCover::covers(const CellLattice::Index& cell) {
  const std::uint64_t key = CellKey::of(cell);
  const auto next = std::ranges::lower_bound(keys_, key);
  const auto is_in_column = [&](std::uint64_t other) { return CellKey::column(other) == CellKey::column(key); };
  if (next == keys_.end() || !is_in_column(*next)) return false;
  if (*next == key) return true;
  if (next == keys_.begin() || !is_in_column(*(next - 1))) return false;
  State& state = state_after_[static_cast<std::size_t>(next - 1 - keys_.begin())];
  if (state == State::unknown) state = is_inside(cell) ? State::inside : State::outside;
  return state == State::inside;
}

Result<bool> CellCover::has_inner_cell(const std::atomic<bool>* cancel) {
  const Monitor monitor(cancel);
  for (std::size_t i = 0; i + 1 < keys_.size(); ++i) {
    A3D_TRY(monitor.check());
    if (CellKey::column(keys_[i]) != CellKey::column(keys_[i + 1]) || keys_[i + 1] == keys_[i] + 1) continue;
    if (covers(CellKey::cell(keys_[i] + 1))) return true;
  }
  return false;
}

Result<TriangleMesh> CellCover::boundary(const std::atomic<bool>* cancel) {
  const Monitor monitor(cancel);
  LatticeSquares squares(lattice_);
  for (const std::uint64_t key : keys_) {
    A3D_TRY(monitor.check());
    const CellLattice::Index cell = CellKey::cell(key);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        const bool is_last = cell[axis] == (is_upper ? lattice_.cell_count(axis) - 1 : 0);
        CellLattice::Index neighbour = cell;
        neighbour[axis] += is_upper ? 1U : ~0U;
        if (is_last || !covers(neighbour)) squares.add(cell, axis, is_upper);
      }
  }
  return std::move(squares).mesh();
}

}  // namespace algebra3d
