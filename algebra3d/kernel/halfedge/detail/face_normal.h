#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/normals.h"

/// Normals of single faces, by doubles where these are good enough.
namespace algebra3d::detail {

/// Limits for results that are good enough: squared sums relative to the products in them, and squared sums.
inline constexpr double kLeastSquaredShare = 0x1p-40, kLeastSquare = 0x1p-800, kLargestSquare = 0x1p800;

/// A limit for corners that are not doubles themselves: relative to the lengths of the vectors that are multiplied and
/// to the largest coordinate.
inline constexpr double kLeastExactShare = 0x1p-36;

/// A multiple of a normal by doubles, and the size of the products that it is a sum of, squared.
struct RoundedNormal {
  Vec3 sum;
  double squared_products = 0;
  double squared_lengths = 0;  ///< of the vectors that are multiplied, of faces with at most four corners
};

inline RoundedNormal rounded_normal(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners) {
  const auto product = [](const Vec3& u, const Vec3& v) {
    return RoundedNormal{cross(u, v), dot(u, u) * dot(v, v), dot(u, u) + dot(v, v)};
  };
  const Vec3 &a = points[corners[0]], &b = points[corners[1]], &c = points[corners[2]];
  if (corners.size() == 3) return product(b - a, c - a);
  if (corners.size() == 4) return product(c - a, points[corners[3]] - b);
  RoundedNormal result;
  double products = 0;
  Vec3 before = b - a;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 next = points[corners[i]] - a;
    result.sum = result.sum + cross(before, next);
    products += 0.5 * (dot(before, before) + dot(next, next));  // no less than the product of the lengths
    before = next;
  }
  result.squared_products = products * products;
  return result;
}

/// Whether corners that are rounded to doubles give the normal within 1e-9. Their vectors u and v move by at most
/// 4 * 2^-53 of the largest coordinate M, so the product moves by 2^-51 M (|u| + |v|): 2^-33 of one that is larger than
/// 2^-18 M (|u| + |v|), where the rounding of the product is below 2^-31.
inline bool is_good_for_rounded(const PointArray& points, std::span<const std::uint32_t> corners,
                                const RoundedNormal& rounded) {
  if (corners.size() > 4) return false;
  double largest = 0;
  for (const std::uint32_t corner : corners)
    for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(points.approx()[corner][axis]));
  // (|u| + |v|)^2 is at most twice the sum of the squares.
  return dot(rounded.sum, rounded.sum) > kLeastExactShare * largest * largest * 2 * rounded.squared_lengths;
}

/// The normal by doubles alone; nothing where that is not within 1e-9: relative to the products the error is below
/// 2^-50 per corner.
inline std::optional<Vec3> quick_normal(const PointArray& points, std::span<const std::uint32_t> corners) {
  const RoundedNormal rounded = rounded_normal(points.approx(), corners);
  if (points.exact_count() != 0 &&
      !std::ranges::all_of(corners, [&](std::uint32_t corner) { return points[corner].is_double(); }) &&
      !is_good_for_rounded(points, corners, rounded))
    return std::nullopt;
  const double squared = dot(rounded.sum, rounded.sum);
  if (!(squared > kLeastSquaredShare * rounded.squared_products) || !(squared > kLeastSquare) ||
      !(squared < kLargestSquare))
    return std::nullopt;
  return 1 / std::sqrt(squared) * rounded.sum;
}

/// As face_normals.
template <typename Layout>
Vec3 face_normal(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  const std::optional<Vec3> quick = quick_normal(mesh.points(), corner_indices(mesh, f));
  return quick ? *quick : vector_area(mesh, f).normal;
}

}  // namespace algebra3d::detail
