#pragma once

#include <optional>

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// An oriented plane: the points x with x.n = c, exactly. The normal is not zero; its length has no meaning.
struct ExactPlane {
  RationalVec3 normal;
  Rational offset;

  /// Through `point` with the given normal; nothing for a zero normal.
  static std::optional<ExactPlane> through(const RationalVec3& point, const RationalVec3& normal);
  /// Through `point`, spanned by two directions, normal u x v; nothing if they are parallel or zero.
  static std::optional<ExactPlane> spanned(const RationalVec3& point, const RationalVec3& u, const RationalVec3& v);
  /// Converts the notation (d nx ny nz): d is the distance from the origin along the normalised normal; the offset is
  /// the double nearest to d|n|. Nothing for a zero or infinite normal, or if d|n| is beyond the range of doubles.
  static std::optional<ExactPlane> from_distance(double distance, const Vec3& normal);

  /// Exact value of p.n - c: positive on the side to which the normal points.
  Rational evaluate(const RationalVec3& p) const;
  /// The canonical form of the oriented plane, with a primitive normal: two oriented planes are the same if and only if
  /// their canonical forms are equal.
  ExactPlane canonical() const;
};

/// The primitive integer vector with the direction of `v`, which must not be zero.
RationalVec3 primitive_direction(const RationalVec3& v);
bool is_zero(const RationalVec3& v);

Rational dot(const RationalVec3& a, const RationalVec3& b);
RationalVec3 cross(const RationalVec3& a, const RationalVec3& b);
RationalVec3 operator+(const RationalVec3& a, const RationalVec3& b);
RationalVec3 operator-(const RationalVec3& a, const RationalVec3& b);
RationalVec3 operator*(const Rational& factor, const RationalVec3& v);

}  // namespace algebra3d
