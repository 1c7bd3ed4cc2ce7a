#include "algebra3d/kernel/search/node_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d {
namespace {

/// A triangle and a box around the origin, by coordinates.
struct CentredPair {
  std::array<std::array<double, 3>, 3> corners;  ///< x of the three corners, then y and z
  std::array<double, 3> half;                    ///< the largest corner of the box

  CentredPair(std::span<const Vec3, 3> triangle, const Box3& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double centre = 0.5 * box.min[axis] + 0.5 * box.max[axis];
      half[axis] = 0.5 * box.max[axis] - 0.5 * box.min[axis];
      for (std::size_t i = 0; i < 3; ++i) corners[axis][i] = triangle[i][axis] - centre;
    }
  }
};

/// A lower bound of the distance, by the gap between the projections to an axis of a length; negative without a gap,
/// and where rounding has made anything of the length. The corners are rounded to some 2^-51 of the largest coordinate
/// and their products with the axis have three more roundings, which `error` covers.
double bound_of(double gap, double squared_length, double error) {
  if (!(gap > 0 && squared_length > 0x1p-800 && squared_length < 0x1p800)) return -1;
  return (1 - 0x1p-46) * (gap / std::sqrt(squared_length) - error);
}

/// Between the products of the corners with an axis, and those of the box, which are up to `reach`.
double gap_between(const std::array<double, 3>& products, double reach) {
  // Not std::minmax of three, which branches.
  const double least = std::min(std::min(products[0], products[1]), products[2]);
  const double greatest = std::max(std::max(products[0], products[1]), products[2]);
  return std::max(least - reach, -greatest - reach);
}

double gap_along_normal(const CentredPair& pair, const Vec3& normal, double error) {
  const auto& [x, y, z] = pair.corners;
  std::array<double, 3> products{};
  for (std::size_t i = 0; i < 3; ++i) products[i] = normal.x * x[i] + normal.y * y[i] + normal.z * z[i];
  const double reach =
      std::abs(normal.x) * pair.half[0] + std::abs(normal.y) * pair.half[1] + std::abs(normal.z) * pair.half[2];
  return bound_of(gap_between(products, reach), dot(normal, normal), error);
}

/// Across x, y or z and an edge from a corner to the next: the axis has no component there.
double gap_across(const CentredPair& pair, std::size_t axis, std::size_t corner, double error) {
  const std::size_t j = axis == 2 ? 0 : axis + 1, k = axis == 0 ? 2 : axis - 1, next = corner == 2 ? 0 : corner + 1;
  const auto &of_j = pair.corners[j], &of_k = pair.corners[k];
  const double along_j = of_k[next] - of_k[corner], along_k = of_j[corner] - of_j[next];
  std::array<double, 3> products{};
  for (std::size_t i = 0; i < 3; ++i) products[i] = along_j * of_j[i] + along_k * of_k[i];
  const double reach = std::abs(along_j) * pair.half[j] + std::abs(along_k) * pair.half[k];
  return bound_of(gap_between(products, reach), along_j * along_j + along_k * along_k, error);
}

}  // namespace

double gap_between(std::span<const Vec3, 3> triangle, const Box3& box, double wanted, double error) {
  const CentredPair pair(triangle, box);
  double best = -1;
  const auto is_enough = [&](double gap) {
    best = std::max(best, gap);
    return best > wanted;
  };
  const Vec3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[1]);
  if (is_enough(gap_along_normal(pair, normal, error))) return best;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (is_enough(bound_of(gap_between(pair.corners[axis], pair.half[axis]), 1, error))) return best;
  for (std::size_t corner = 0; corner < 3; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (is_enough(gap_across(pair, axis, corner, error))) return best;
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
