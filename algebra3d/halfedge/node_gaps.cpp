#include "algebra3d/halfedge/node_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra3d/exact/predicates_filter.h"

namespace algebra3d {
namespace {

/// A triangle and a box around the origin, of which `half` is the largest corner.
struct CentredPair {
  std::array<Vec3, 3> corners;
  Vec3 half;
};

/// The gap between the projections to an axis of any length, whatever rounding has made of it. The corners are rounded
/// to some 2^-51 of the largest coordinate and their products with the axis have three more roundings, which `error`
/// covers.
double gap_along(const CentredPair& pair, const Vec3& axis, double error) {
  const double length = std::sqrt(dot(axis, axis));
  if (!(length > 0x1p-400 && length < 0x1p400)) return -1;
  const auto [least, greatest] =
      std::minmax({dot(axis, pair.corners[0]), dot(axis, pair.corners[1]), dot(axis, pair.corners[2])});
  const double reach = std::abs(axis.x) * pair.half.x + std::abs(axis.y) * pair.half.y + std::abs(axis.z) * pair.half.z;
  const double gap = std::max(least - reach, -greatest - reach);
  return (1 - 0x1p-46) * (gap / length - error);
}

}  // namespace

double gap_between(std::span<const Vec3, 3> triangle, const Box3& box, double wanted, double error) {
  const Vec3 centre = 0.5 * box.min + 0.5 * box.max;
  const CentredPair pair{{triangle[0] - centre, triangle[1] - centre, triangle[2] - centre},
                         0.5 * box.max - 0.5 * box.min};
  double best = -1;
  const auto is_enough = [&](const Vec3& axis) {
    best = std::max(best, gap_along(pair, axis, error));
    return best > wanted;
  };
  constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<Vec3, 3> edges{triangle[1] - triangle[0], triangle[2] - triangle[1], triangle[0] - triangle[2]};
  if (is_enough(cross(edges[0], edges[1]))) return best;
  for (const Vec3& axis : kAxes)
    if (is_enough(axis)) return best;
  for (const Vec3& edge : edges)
    for (const Vec3& axis : kAxes)
      if (is_enough(cross(edge, axis))) return best;
  return best;
}

NodeGaps::NodeGaps(const TriangleMesh& first, const BoxHierarchy& of_first, const TriangleMesh& second,
                   const BoxHierarchy& of_second)
    : first_{first, of_first}, second_{second, of_second} {
  const Box3 box = unite(of_first.bounds(), of_second.bounds());
  error_ = 0x1p-46 * std::max(detail::largest(box.min), detail::largest(box.max)) + 0x1p-1000;
}

bool NodeGaps::are_far(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) {
  if (!std::isfinite(distance)) return false;
  return are_far(first_, first, second_.hierarchy.bounds(second), distance) ||
         are_far(second_, second, first_.hierarchy.bounds(first), distance);
}

bool NodeGaps::are_far(const Side& side, BoxHierarchy::Node node, const Box3& box, double distance) {
  const std::vector<Vec3>& points = side.mesh.points().approx();
  return std::ranges::all_of(side.hierarchy.faces_of(node), [&](std::uint32_t face) {
    const auto [a, b, c] = side.mesh.triangle(FaceId(face));
    --credit_;
    return gap_between(std::array{points[a], points[b], points[c]}, box, distance, error_) > distance;
  });
}

}  // namespace algebra3d
