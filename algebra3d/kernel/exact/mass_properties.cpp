#include "algebra3d/kernel/exact/mass_properties.h"

#include <utility>

#include "base/propagate.h"

namespace algebra3d {

Result<MassProperties> mass_properties(const PointArray& points, IndexTriangles triangles,
                                       const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const SolidSecondMoments moments, exact_second_moments(points, triangles, cancel));
  const auto& [volume, first] = moments.lower;
  const auto& [xx, yy, zz, yz, zx, xy] = moments.second;
  MassProperties result;
  result.volume = volume;
  result.centre = Rational(1) / volume * first;
  // About the centre: the parallel axis theorem.
  const RationalVec3& c = result.centre;
  const Rational xx_about = xx - c.x * first.x, yy_about = yy - c.y * first.y, zz_about = zz - c.z * first.z;
  result.inertia = {yy_about + zz_about, zz_about + xx_about, xx_about + yy_about,
                    c.y * first.z - yz,  c.z * first.x - zx,  c.x * first.y - xy};
  return result;
}

}  // namespace algebra3d
