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

/// A multiple of a normal by doubles, and the size of the products that it is a sum of, squared.
struct RoundedNormal {
  Vec3 sum;
  double squared_products = 0;
};

inline RoundedNormal rounded_normal(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners) {
  const auto product = [](const Vec3& u, const Vec3& v) { return RoundedNormal{cross(u, v), dot(u, u) * dot(v, v)}; };
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

/// The normal by doubles alone; nothing where that is not within 1e-9: relative to the products the error is below
/// 2^-50 per corner.
inline std::optional<Vec3> quick_normal(const PointArray& points, std::span<const std::uint32_t> corners) {
  if (points.exact_count() != 0 &&
      !std::ranges::all_of(corners, [&](std::uint32_t corner) { return points[corner].is_double(); }))
    return std::nullopt;
  const RoundedNormal rounded = rounded_normal(points.approx(), corners);
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
