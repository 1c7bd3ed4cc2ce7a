#include "algebra3d/arrangement/wedges.h"

#include <algorithm>
#include <cassert>
#include <compare>
#include <span>
#include <tuple>

#include "algebra3d/arrangement/bucket_sort.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// A piece as it leaves one of its ends.
struct Spoke {
  std::uint32_t plane, vertex, piece, other;

  /// The sides to the left and right of someone who walks away from the vertex.
  std::uint32_t left() const { return vertex < other ? 2 * piece : 2 * piece + 1; }
  std::uint32_t right() const { return vertex < other ? 2 * piece + 1 : 2 * piece; }
};

/// Angular order of the spokes at a vertex, from the direction just beyond -y (or -x) counter-clockwise.
class AngularOrder {
 public:
  AngularOrder(const VertexPool& points, Projection projection, std::uint32_t centre)
      : points_(points), projection_(projection), centre_(centre) {}

  bool operator()(const Spoke& a, const Spoke& b) const {
    const bool a_later = is_later(a.other), b_later = is_later(b.other);
    if (a_later != b_later) return a_later;
    return orient2d(projection_, points_[centre_], points_[a.other], points_[b.other]) > 0;
  }

 private:
  /// True in the half-plane that comes first: directions of greater first, or equal first and greater second
  /// coordinate.
  bool is_later(std::uint32_t vertex) const {
    auto order = compare(first_axis(projection_), points_[vertex], points_[centre_]);
    if (std::is_eq(order)) order = compare(second_axis(projection_), points_[vertex], points_[centre_]);
    return std::is_gt(order);
  }

  const VertexPool& points_;
  Projection projection_;
  std::uint32_t centre_;
};

void join_around(std::span<const Spoke> spokes, const Pieces& pieces, WindingSets& sides) {
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const std::uint32_t left = spokes[i].left(), right = spokes[i + 1 == spokes.size() ? 0 : i + 1].right();
    assert(pieces.is_covered(left) == pieces.is_covered(right));
    if (pieces.is_covered(left)) sides.unite(left, right, {});
  }
}

}  // namespace

void join_cells(const Skeleton& skeleton, const Pieces& pieces, WindingSets& sides) {
  std::vector<Spoke> spokes;
  spokes.reserve(2 * pieces.pieces.size());
  for (std::uint32_t p = 0; p < pieces.pieces.size(); ++p) {
    const Piece& piece = pieces.pieces[p];
    spokes.push_back({piece.plane, piece.u, p, piece.v});
    spokes.push_back({piece.plane, piece.v, p, piece.u});
  }
  bucket_sort(
      spokes, skeleton.facets().planes().size(), [](const Spoke& s) { return s.plane; },
      [](const Spoke& s, const Spoke& t) {
        return std::tuple(s.plane, s.vertex, s.piece) < std::tuple(t.plane, t.vertex, t.piece);
      });
  for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
    while (end < spokes.size() && spokes[end].plane == spokes[begin].plane &&
           spokes[end].vertex == spokes[begin].vertex)
      ++end;
    const auto around = std::span(spokes).subspan(begin, end - begin);
    if (around.size() > 2)
      std::ranges::sort(around, AngularOrder(skeleton.vertices(),
                                             skeleton.facets().planes()[around[0].plane].projection, around[0].vertex));
    join_around(around, pieces, sides);
  }
}

}  // namespace algebra3d::arrangement
