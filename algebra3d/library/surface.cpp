#include "algebra3d/geometry/surface.h"

#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/library/detail/surroundings.h"
#include "algebra3d/library/shape_access.h"
#include "algebra3d/values/constructions/solid_sets.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

namespace algebra3d {
namespace {

using detail::ShapeAccess;

Result<Surface> combined_by(SurfaceRule rule, const Surface& a, const Surface& b, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Surface> {
    detail::Surroundings surroundings(monitor);
    return ShapeAccess::outer(combined(surroundings.context, ShapeAccess::content(a), ShapeAccess::content(b), rule));
  });
}

}  // namespace

Surface::Surface() = default;

Surface boundary(const Solid& solid) {
  return ShapeAccess::outer(Surface3d::trusted(ShapeAccess::content(solid).mesh()));
}

Result<Surface> section(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Surface> {
    A3D_ASSIGN(const Plane3d plane, detail::plane_through("section", point, normal));
    detail::Surroundings surroundings(monitor);
    return ShapeAccess::outer(section(surroundings.context, ShapeAccess::content(solid), plane.plane));
  });
}

Result<Surface> unite(const Surface& a, const Surface& b, const Monitor& monitor) {
  return combined_by(SurfaceRule::either, a, b, monitor);
}

Result<Surface> intersect(const Surface& a, const Surface& b, const Monitor& monitor) {
  return combined_by(SurfaceRule::both, a, b, monitor);
}

Result<Surface> subtract(const Surface& a, const Surface& b, const Monitor& monitor) {
  return combined_by(SurfaceRule::first_only, a, b, monitor);
}

}  // namespace algebra3d
