#pragma once

#include "algebra3d/values/constructions/value_images.h"

namespace algebra3d {

// Motions and scalings of values, for every T of which `image_of` (value_images.h) makes an image: exactness, undefined
// results and errors are its own.

/// Rotated about the axis through `centre` with a direction, right-handed. Undefined for a zero axis.
template <typename T>
Result<Maybe<T>> rotated(Context& context, const T& geometry, const Point3d& centre, const Vector3d& axis,
                         double angle_degrees) {
  const auto map = AffineMap::rotation(centre.position.rational(), axis.components.rational(), angle_degrees);
  if (!map) return Maybe<T>(Undefined{"the axis is the zero vector"});
  return image_of(context, *map, geometry);
}

/// The mirror image at a plane; the outside of a solid stays outside.
template <typename T>
Result<Maybe<T>> mirrored(Context& context, const T& geometry, const Plane3d& plane) {
  return image_of(context, AffineMap::reflection(plane.plane), geometry);
}

template <typename T>
Result<Maybe<T>> translated(Context& context, const T& geometry, const Vector3d& by) {
  return image_of(context, AffineMap::translation(by.components.rational()), geometry);
}

/// p + f(x - p) for the centre p and the factor f.
template <typename T>
Result<Maybe<T>> scaled(Context& context, const T& geometry, const Point3d& centre, double factor) {
  const Rational f(factor);
  return image_of(context, AffineMap::scaling(centre.position.rational(), RationalVec3(f, f, f)), geometry);
}

/// p + v(x - p), componentwise.
template <typename T>
Result<Maybe<T>> scaled_by_axis(Context& context, const T& geometry, const Point3d& centre, const Vector3d& factors) {
  return image_of(context, AffineMap::scaling(centre.position.rational(), factors.components.rational()), geometry);
}

}  // namespace algebra3d
