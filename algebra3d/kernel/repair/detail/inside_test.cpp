#include "algebra3d/kernel/repair/detail/inside_test.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/vertical_line.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// So many rays go through the solid together; cancellation is looked for between them.
constexpr std::size_t kRaysTogether = 1024;

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

Result<std::vector<bool>> InsideTest::are_inside(std::span<const Vec3> points, const Monitor& monitor) const {
  std::vector<bool> result(points.size());
  for (std::size_t begin = 0; begin < points.size(); begin += kRaysTogether) {
    A3D_TRY(monitor.check());
    std::vector<std::size_t> asked;  // points outside the box have no ray
    std::vector<Box3> starts;
    for (std::size_t i = begin; i < std::min(begin + kRaysTogether, points.size()); ++i)
      if (hierarchy_.bounds().contains(points[i])) {
        asked.push_back(i);
        starts.push_back(Box3::of(points[i]));
      }
    std::vector<int> windings(asked.size());
    hierarchy_.for_each_on_upward_rays(starts, [&](std::size_t ray, auto face) {
      const LineCrossing crossing = cross_vertical_line(points[asked[ray]], solid_.corners(FaceId(face)));
      if (crossing.side == -1) windings[ray] += crossing.sign;
    });
    for (std::size_t ray = 0; ray < asked.size(); ++ray) result[asked[ray]] = windings[ray] > 0;
  }
  return result;
}

}  // namespace algebra3d
