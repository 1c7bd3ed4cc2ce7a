#pragma once

#include <functional>

#include "algebra3d/geometry/shape.h"
#include "algebra3d/geometry/solid.h"

namespace algebra3d {

/// A surface: triangles that meet only in common corners and whole common edges; may have a boundary, may be empty. Its
/// members are those of Shape.
class Surface : public Shape<Surface, Surface3d> {
 public:
  Surface();  ///< the empty surface

 private:
  friend struct detail::ShapeAccess;
  using Shape::Shape;
};

/// The boundary of a solid, with its front outside.
Surface boundary(const Solid& solid);
/// The section of a solid by the plane through a point with a normal. Errors: invalid_value for a normal of length 0;
/// interrupted.
Result<Surface> section(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor = {});

// Set operations on surfaces: triangles are divided at one another, and their parts are selected; overlaps count once.
Result<Surface> unite(const Surface& a, const Surface& b, const Monitor& monitor = {});
Result<Surface> intersect(const Surface& a, const Surface& b, const Monitor& monitor = {});
Result<Surface> subtract(const Surface& a, const Surface& b, const Monitor& monitor = {});

}  // namespace algebra3d

template <>
struct std::hash<algebra3d::Surface> {
  std::size_t operator()(const algebra3d::Surface& surface) const { return surface.hash(); }
};
