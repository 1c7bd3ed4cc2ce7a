#include "algebra3d/values/constructions/planes.h"

#include <utility>

namespace algebra3d {

Maybe<Plane3d> plane_through(const Point3d& point, const Vector3d& normal) {
  const RationalVec3 p = point.position.rational();
  auto plane = ExactPlane::through(p, normal.components.rational());
  if (!plane) return Undefined{"the normal is the zero vector"};
  return Plane3d{std::move(*plane), p, nullptr};
}

Maybe<Plane3d> plane_spanned(const Point3d& point, const Vector3d& u, const Vector3d& v) {
  const RationalVec3 p = point.position.rational();
  auto plane = ExactPlane::spanned(p, u.components.rational(), v.components.rational());
  if (!plane) return Undefined{"the two directions are parallel or zero"};
  return Plane3d{std::move(*plane), p, nullptr};
}

}  // namespace algebra3d
