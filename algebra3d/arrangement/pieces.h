#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/skeleton.h"

namespace algebra3d::arrangement {

/// Windings about a place, one number per group.
using Windings = std::array<std::int32_t, 2>;

inline Windings operator+(Windings a, const Windings& b) {
  return {a[0] + b[0], a[1] + b[1]};
}
inline Windings operator-(Windings a, const Windings& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

/// A facet that holds a piece, on both sides of it or on one, seen from the front of the piece's plane.
struct Cover {
  std::uint32_t facet;
  Side side;

  bool is_on(Side one_side) const { return side == Side::both || side == one_side; }
};

/// One straight line of the subdivision of one plane, which no other one crosses: the ends are two vertices, u < v, and
/// to its left and right lie two cells (parts of the plane that no piece divides). The sides are called as someone sees
/// them who looks at the front of the plane and walks from u to v.
struct Piece {
  std::uint32_t u, v;
  std::uint32_t plane;
  std::uint32_t first_cover, last_cover;  ///< range of Pieces::covers
  /// By how much the windings behind the plane exceed those in front of it, in the cell to the left and to the right;
  /// set by count_steps.
  std::array<Windings, 2> steps;
};

/// The vertices along each segment.
class CutSegments {
 public:
  CutSegments() = default;
  /// At the skeleton's cuts, which are sorted for that.
  explicit CutSegments(Skeleton& skeleton);

  /// From one end to the other.
  std::span<const std::uint32_t> vertices(std::uint32_t segment) const {
    return std::span(vertices_).subspan(first_[segment], first_[segment + 1] - first_[segment]);
  }

 private:
  std::vector<std::uint32_t> first_, vertices_;
};

/// All pieces of all planes, by u and v, then by plane: so the pieces along one line in space are neighbours. A piece
/// of closed operands knows all facets of its plane that hold it: it lies where some boundary or common part runs, and
/// whatever other facet of the plane is there has a common part with the same facet there.
struct Pieces {
  std::vector<Piece> pieces;
  std::vector<Cover> covers;
  CutSegments segments;

  /// True if a facet covers the cell on the side: twice the piece for the left one, one more for the right one.
  bool is_covered(std::uint32_t cell_side) const {
    const Side side = cell_side % 2 == 0 ? Side::left : Side::right;
    return std::ranges::any_of(covers_of(pieces[cell_side / 2]), [side](const Cover& c) { return c.is_on(side); });
  }
  /// Those along the line between two vertices, one for each plane.
  std::span<const Piece> along(std::uint32_t a, std::uint32_t b) const {
    const std::pair<std::uint32_t, std::uint32_t> ends(std::min(a, b), std::max(a, b));
    const auto line = [](const Piece& p) { return std::pair(p.u, p.v); };
    const auto first = std::ranges::lower_bound(pieces, ends, {}, line);
    return {first, std::ranges::upper_bound(first, pieces.end(), ends, {}, line)};
  }
  std::span<const Cover> covers_of(const Piece& piece) const {
    return std::span(covers).subspan(piece.first_cover, piece.last_cover - piece.first_cover);
  }
};

/// Divides the segments at their cuts. Cost: n log n.
Pieces divide(Skeleton& skeleton);
/// Sets the steps of all pieces, from their covers. Cost: linear.
void count_steps(const Skeleton& skeleton, Pieces& pieces);

}  // namespace algebra3d::arrangement
