#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// The vector area of a polygon in space, as direction and length. Its components are the signed areas of the polygon's
/// projections along the axes: for a flat polygon normal and area, for a bent one those of the plane in which it
/// encloses most.
struct VectorArea {
  Vec3 normal;      ///< of length 1, the polygon turns counter-clockwise seen from its tip; zero if the area is 0
  double area = 0;  ///< may be infinite

  /// False if the polygon has no direction.
  bool has_normal() const { return normal != Vec3{}; }
};

/// Vector area of the polygon with the given corners, by the numbers of their points. Units: squared coordinate units.
/// Domain: any points. Exactness: each number rounded once, so that parallel faces have equal normals. Cost: per corner
/// tens of nanoseconds for doubles between 2^-100 and 2^200, microseconds for other points and where a result is very
/// close to the middle between two doubles. Source: [newell1972].
VectorArea nearest_vector_area(const PointArray& points, std::span<const std::uint32_t> corners);

/// Twice the vector area of the polygon, as a vector. Exact. Cost: microseconds per corner.
RationalVec3 exact_doubled_vector_area(const PointArray& points, std::span<const std::uint32_t> corners);

/// The mean of some points, at least one: the centroid of a triangle. Exactness and cost: as nearest_vector_area.
Vec3 nearest_mean(const PointArray& points, std::span<const std::uint32_t> corners);

/// The distance of two points. Exactness and cost: as nearest_vector_area.
double nearest_distance(const PointRef& a, const PointRef& b);

}  // namespace algebra3d
