#include "algebra3d/kernel/repair/detail/inside_test.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/axis_line.h"
#include "algebra3d/kernel/exact/vertical_line.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// So many rays go through the solid together; cancellation is looked for between them.
constexpr std::size_t kRaysTogether = 1024;
constexpr std::size_t kVertical = 2;
/// So many rays show which axis to take.
constexpr std::size_t kTrialRays = 32;

}  // namespace

InsideTest::InsideTest(const TriangleMesh& solid) : solid_(solid), hierarchy_(solid) {}

bool InsideTest::is_inside(const Vec3& point) const {
  if (!hierarchy_.bounds().contains(point)) return false;
  int winding = 0;
  hierarchy_.for_each_on_vertical_ray(Box3::of(point), 1, [&](std::uint32_t face) {
    const LineCrossing crossing = cross_vertical_line(point, solid_.corners(FaceId(face)));
    if (crossing.side == -1) winding += crossing.sign;
  });
  return winding > 0;
}

/// The ray from a point along an axis as far as the box reaches.
Box3 InsideTest::ray_from(const Vec3& point, std::size_t axis) const {
  Box3 ray = Box3::of(point);
  ray.max[axis] = hierarchy_.bounds().max[axis];
  return ray;
}

/// The axis along which rays from some of the points meet the fewest boxes. Along a chain of bodies each ray meets all
/// that follow, and across it one. Vertical rays go through the solid together, so others must meet far fewer.
std::size_t InsideTest::axis_of_rays(std::span<const Vec3> points) const {
  if (points.size() < 8 * kTrialRays) return kVertical;
  std::array<std::size_t, 3> met{};
  for (std::size_t axis = 0; axis < met.size(); ++axis)
    for (std::size_t i = 0; i < kTrialRays; ++i) {
      const Vec3& point = points[i * (points.size() / kTrialRays)];
      if (!hierarchy_.bounds().contains(point)) continue;
      hierarchy_.for_each_meeting(ray_from(point, axis), [&](std::uint32_t) { return ++met[axis] > 0; });
    }
  const auto best = static_cast<std::size_t>(std::ranges::min_element(met) - met.begin());
  return 3 * met[best] < met[kVertical] ? best : kVertical;
}

bool InsideTest::is_inside_along(std::size_t axis, const Vec3& point) const {
  int winding = 0;
  hierarchy_.for_each_meeting(ray_from(point, axis), [&](std::uint32_t face) {
    const LineCrossing crossing = cross_axis_line(axis, point, solid_.corners(FaceId(face)));
    if (crossing.side == -1) winding += crossing.sign;
    return true;
  });
  return winding > 0;
}

Result<std::vector<bool>> InsideTest::are_inside(std::span<const Vec3> points, const Monitor& monitor) const {
  std::vector<bool> result(points.size());
  const std::size_t axis = axis_of_rays(points);
  for (std::size_t begin = 0; begin < points.size(); begin += kRaysTogether) {
    A3D_TRY(monitor.check());
    const std::size_t end = std::min(begin + kRaysTogether, points.size());
    std::vector<std::size_t> asked;  // points outside the box have no ray
    for (std::size_t i = begin; i < end; ++i)
      if (hierarchy_.bounds().contains(points[i])) asked.push_back(i);
    if (axis == kVertical) look_upwards(points, asked, result);
    if (axis != kVertical)
      for (const std::size_t i : asked) result[i] = is_inside_along(axis, points[i]);
  }
  return result;
}

/// Sets the answers of the points that are asked.
void InsideTest::look_upwards(std::span<const Vec3> points, const std::vector<std::size_t>& asked,
                              std::vector<bool>& answers) const {
  std::vector<Box3> starts;
  for (const std::size_t i : asked) starts.push_back(Box3::of(points[i]));
  std::vector<int> windings(asked.size());
  hierarchy_.for_each_on_upward_rays(starts, [&](std::size_t ray, auto face) {
    const LineCrossing crossing = cross_vertical_line(points[asked[ray]], solid_.corners(FaceId(face)));
    if (crossing.side == -1) windings[ray] += crossing.sign;
  });
  for (std::size_t ray = 0; ray < asked.size(); ++ray) answers[asked[ray]] = windings[ray] > 0;
}

}  // namespace algebra3d
