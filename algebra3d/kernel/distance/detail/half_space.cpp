#include "algebra3d/kernel/distance/detail/half_space.h"

#include <cmath>
#include <limits>
#include <utility>

#include "algebra3d/kernel/exact/plane.h"

namespace algebra3d::distances {
namespace {

Vec3 rounded(const RationalVec3& v) {
  return {v.x.nearest_double(), v.y.nearest_double(), v.z.nearest_double()};
}

}  // namespace

HalfSpace::HalfSpace(RationalVec3 point, RationalVec3 normal)
    : point_(std::move(point)),
      normal_(std::move(normal)),
      rounded_point_(rounded(point_)),
      rounded_normal_(rounded(normal_)) {}

// Each number is rounded by less than 2^-51 of itself, or by less than 2^-1070, and so is each operation.
bool HalfSpace::has(const PointRef& point) const {
  double product = 0, size = 0, sum = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double normal = rounded_normal_[axis], before = rounded_point_[axis], at = point.approx[axis];
    const double coordinates = std::abs(at) + std::abs(before);
    product += normal * (at - before);
    size += std::abs(normal) * coordinates;
    sum += std::abs(normal) + coordinates;
  }
  constexpr double kRoundings = 0x1p-47, kTiny = 0x1p-1000, kInfinity = std::numeric_limits<double>::infinity();
  if (size < kInfinity && sum < kInfinity && std::abs(product) > kRoundings * size + kTiny * sum) return product > 0;
  return dot(normal_, point.rational() - point_).sign() >= 0;
}

}  // namespace algebra3d::distances
