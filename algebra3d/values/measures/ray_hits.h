#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// Where a ray goes at a hit. Solid: from outside to inside, from inside to outside, or it stays on one side. A ray
/// that begins on the boundary enters or leaves by how it goes on. Surface: through the triangles there from their
/// front, from behind, or neither.
enum class RayHitKind : std::uint8_t { entering, leaving, touching };
/// Its name in results: "entering".
std::string_view name_of(RayHitKind kind);

/// A connected part of the intersection of a ray and a boundary: a point, or a run along faces or edges.
struct RayHit {
  Rational first, last;                ///< parameters of its ends, which are equal for a point
  ExactPoint first_point, last_point;  ///< its ends
  RayHitKind kind;
  FaceId face;  ///< the lowest of the triangles that hold the first point
};

/// All hits of the ray origin + t * direction, t >= 0, with the boundary of a solid, or with a surface, in ascending
/// order. The direction must not be zero. Exact. Cost: that of the triangles whose boxes the ray meets, and of locating
/// a point for each hit that is in no inside of a triangle.
std::vector<RayHit> ray_hits(const Volume3d& solid, const RationalVec3& origin, const RationalVec3& direction);
std::vector<RayHit> ray_hits(const Surface3d& surface, const RationalVec3& origin, const RationalVec3& direction);

}  // namespace algebra3d
