// A closed surface has the volume of the pyramids over its triangles with their apex in any point t: a sixth of the sum
// of det(a - t, b - t, c - t). Differences, products and sums of doubles are off by a factor of at most 1 +- u, u =
// 2^-53, but for underflow. A determinant goes through eight of them, so it is off by less than 9u times the same sum
// with all terms positive, its permanent; the sum of n determinants by less than (n + 9)u times that of the permanents.
// That sum is itself too small by a factor of at most 1 - (n + 9)u. The bound below is four times as large. A product
// that underflows is off by at most 2^-1074 more, times an extent; within the range that is asked for all of them
// together stay far below what is added for them.

#include "algebra3d/kernel/repair/detail/shell_volumes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "algebra3d/base/box3.h"

namespace algebra3d {
namespace {

/// A determinant, and the sum of its terms without their signs.
struct SignedTerms {
  double sum, sizes;
};

SignedTerms determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<double, 3> plus{b.y * c.z, b.z * c.x, b.x * c.y}, minus{b.z * c.y, b.x * c.z, b.y * c.x};
  SignedTerms result{0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.sum += a[axis] * (plus[axis] - minus[axis]);
    result.sizes += std::abs(a[axis]) * (std::abs(plus[axis]) + std::abs(minus[axis]));
  }
  return result;
}

}  // namespace

Estimate estimated_volume(const TriangleMesh& mesh, std::span<const FaceId> faces) {
  constexpr double kSmallest = 1e-60, kLargest = 1e60, kForUnderflow = 1e-200;
  const std::vector<Vec3>& points = mesh.points().approx();
  Box3 box;
  for (const FaceId face : faces)
    for (const std::uint32_t corner : mesh.triangle(face)) box.extend(points[corner]);
  const Vec3 extent = box.max - box.min, apex = 0.5 * box.min + 0.5 * box.max;
  const double largest = std::max({extent.x, extent.y, extent.z});
  if (!(largest > kSmallest && largest < kLargest)) return {0, std::numeric_limits<double>::infinity()};
  SignedTerms total{0, 0};
  for (const FaceId face : faces) {
    const auto& [a, b, c] = mesh.triangle(face);
    const SignedTerms one = determinant(points[a] - apex, points[b] - apex, points[c] - apex);
    total.sum += one.sum;
    total.sizes += one.sizes;
  }
  const double steps = static_cast<double>(faces.size()) + 9;
  return {total.sum / 6, steps * 0x1p-51 * total.sizes + kForUnderflow};
}

}  // namespace algebra3d
