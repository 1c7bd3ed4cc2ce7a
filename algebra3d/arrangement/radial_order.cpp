#include "algebra3d/arrangement/radial_order.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

class AroundLine {
 public:
  AroundLine(const Skeleton& skeleton, const Pieces& pieces) : skeleton_(skeleton), pieces_(pieces) {}

  /// Sign of the sine of the angle from a to b: 1 if b is met within half a turn, 0 if b is opposite to a.
  int turn(const HalfPlane& a, const HalfPlane& b) const {
    const int normals = turn_of_normals(pieces_.pieces[a.piece], pieces_.pieces[b.piece]);
    return a.side == b.side ? normals : -normals;
  }

 private:
  /// Sign of d (m x n), where d runs from u to v and m, n are the normals of the two planes. A left half-plane turned
  /// by a right angle is its plane's normal, so the angles between left half-planes are those between normals.
  int turn_of_normals(const Piece& a, const Piece& b) const {
    if (a.plane == b.plane) return 0;
    const Plane& plane_a = skeleton_.facets().planes()[a.plane];
    const TriangleRef& in_b = skeleton_.facets().planes()[b.plane].triangle;
    const PointRef u = skeleton_.vertices()[a.u], v = skeleton_.vertices()[a.v];
    for (const PointRef& corner : plane_a.triangle) {
      const int side = orient2d(plane_a.projection, u, v, corner);
      // The direction to the left of the line is m x d, and n (m x d) = - d (m x n).
      if (side != 0) return -side * orient3d(in_b[0], in_b[1], in_b[2], corner);
    }
    assert(false && "a triangle on a line");
    return 0;
  }

  const Skeleton& skeleton_;
  const Pieces& pieces_;
};

}  // namespace

void sort_around_line(const Skeleton& skeleton, const Pieces& pieces, std::span<HalfPlane> half_planes) {
  if (half_planes.size() < 3) return;
  const AroundLine line(skeleton, pieces);
  struct Turned {
    int half;  ///< 0 within the first half turn, 1 opposite, 2 beyond
    HalfPlane half_plane;
  };
  std::vector<Turned> turned;
  for (const HalfPlane& h : half_planes.subspan(1)) turned.push_back({1 - line.turn(half_planes[0], h), h});
  std::ranges::stable_sort(turned, [&](const Turned& a, const Turned& b) {
    return a.half != b.half ? a.half < b.half : line.turn(a.half_plane, b.half_plane) > 0;
  });
  for (std::size_t i = 0; i < turned.size(); ++i) half_planes[i + 1] = turned[i].half_plane;
}

int turn_around_line(const Skeleton& skeleton, const Pieces& pieces, const HalfPlane& a, const HalfPlane& b) {
  return AroundLine(skeleton, pieces).turn(a, b);
}

}  // namespace algebra3d::arrangement
