#pragma once

#include <vector>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// The points origin + t * direction for t from 0 on. The direction is not zero.
struct Ray {
  RationalVec3 origin, direction;

  RationalVec3 at(const Rational& parameter) const { return origin + parameter * direction; }
};

/// The common part of a ray and a triangle: the points with parameters from `first` to `last`.
struct RaySection {
  Rational first, last;
  FaceId face;
  /// 1 if the ray comes from behind the triangle, -1 if from its front, 0 if it lies in its plane.
  int sign = 0;
};

/// The sections of all triangles, in ascending order, then by their faces. Exact. Cost: that of the triangles whose
/// boxes the ray meets; microseconds for each one that it meets.
std::vector<RaySection> sections_of(const Ray& ray, const Geometry& geometry);

}  // namespace algebra3d
