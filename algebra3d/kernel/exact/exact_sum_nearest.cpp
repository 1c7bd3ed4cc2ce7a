#include <cstddef>
#include <optional>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/detail/moment_bounds.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::kFewLimbs, detail::kManyLimbs;
using detail::moment_bounds, detail::MomentBounds;

template <std::size_t Limbs>
Result<std::optional<double>> rounded_volume(const PointArray& points, IndexTriangles triangles,
                                             const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const MomentBounds bounds, (moment_bounds<0, Limbs>(points, triangles, cancel)));
  return bounds.volume.nearest_double();
}

template <std::size_t Limbs>
Result<std::optional<Vec3>> rounded_centroid(const PointArray& points, IndexTriangles triangles,
                                             const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const MomentBounds bounds, (moment_bounds<1, Limbs>(points, triangles, cancel)));
  if (bounds.volume.has_zero()) return std::optional<Vec3>();
  Vec3 centroid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double> nearest = (bounds.first[axis] / bounds.volume).nearest_double();
    if (!nearest) return std::optional<Vec3>();
    centroid[axis] = *nearest;
  }
  return std::optional(centroid);
}

/// An attempt with few limbs, or else with many. Nothing if neither decides, and for doubles, whose exact sum is fast.
template <typename T, typename Attempt>
Result<std::optional<T>> by_bounds(const PointArray& points, const Attempt& attempt) {
  if (points.exact_count() == 0) return std::optional<T>();
  Result<std::optional<T>> result = attempt.template operator()<kFewLimbs>();
  if (result.ok() && !*result) result = attempt.template operator()<kManyLimbs>();
  if (result.ok() && !*result) detail::count_filter_failure();
  return result;
}

}  // namespace

Result<double> nearest_volume(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  const auto attempt = [&]<std::size_t Limbs>() { return rounded_volume<Limbs>(points, triangles, cancel); };
  A3D_ASSIGN(const std::optional<double> bounded, by_bounds<double>(points, attempt));
  if (bounded) return *bounded;
  A3D_ASSIGN(const Rational volume, exact_volume(points, triangles, cancel));
  return volume.nearest_double();
}

Result<Vec3> nearest_centroid(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel) {
  const auto attempt = [&]<std::size_t Limbs>() { return rounded_centroid<Limbs>(points, triangles, cancel); };
  A3D_ASSIGN(const std::optional<Vec3> bounded, by_bounds<Vec3>(points, attempt));
  if (bounded) return *bounded;
  A3D_ASSIGN(const SolidMoments moments, exact_moments(points, triangles, cancel));
  const auto coordinate = [&](std::size_t axis) { return (moments.first[axis] / moments.volume).nearest_double(); };
  return Vec3{coordinate(0), coordinate(1), coordinate(2)};
}

}  // namespace algebra3d
