#include "algebra3d/kernel/repair/detail/inside_test.h"

#include "algebra3d/kernel/exact/vertical_line.h"

namespace algebra3d {
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

}  // namespace algebra3d
