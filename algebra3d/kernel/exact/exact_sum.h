#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// Triangles over shared points, as index triples into a PointArray.
using IndexTriangles = std::span<const std::array<std::uint32_t, 3>>;

/// Volume enclosed by a closed oriented mesh (negative if it is inside out): a sixth of the sum of the determinants of
/// all triangles. Units: cubed coordinate units. Domain: any triangles; if they are not closed, the volume depends on
/// the origin. Exactness: exact. Errors: interrupted, once `*cancel` is set (null: never). Cost: linear; per triangle
/// tens of nanoseconds where the coordinates of each axis are less than 60 bits apart (as floats mostly are), about a
/// hundred up to 124 bits, more beyond, microseconds at corners that are not doubles. Source: [lien1984].
Result<Rational> exact_volume(const PointArray& points, IndexTriangles triangles,
                              const std::atomic<bool>* cancel = nullptr);

/// `exact_volume`, rounded to nearest, with the same errors. Cost: linear; as `exact_volume` for doubles, and where
/// corners are not doubles less than a microsecond per triangle, since coordinates that are cut off and a bound of the
/// change nearly always decide. If they do not, that of `exact_volume` (counted in `exact_counters().filter_failures`).
Result<double> nearest_volume(const PointArray& points, IndexTriangles triangles,
                              const std::atomic<bool>* cancel = nullptr);

/// The volume, and the integrals of x, y and z over the solid.
struct SolidMoments {
  Rational volume;
  RationalVec3 first;
};
/// Volume and first moments. As `exact_volume`, at about twice the cost.
Result<SolidMoments> exact_moments(const PointArray& points, IndexTriangles triangles,
                                   const std::atomic<bool>* cancel = nullptr);

/// The first moments divided by the volume, which must not be 0; each coordinate rounded to nearest. Errors and cost as
/// `nearest_volume`, about twice as much.
Result<Vec3> nearest_centroid(const PointArray& points, IndexTriangles triangles,
                              const std::atomic<bool>* cancel = nullptr);

/// These, and the integrals of xx, yy, zz, yz, zx and xy.
struct SolidSecondMoments {
  SolidMoments lower;
  std::array<Rational, 6> second;
};
/// Volume, first and second moments. As `exact_volume`, at about four times the cost.
Result<SolidSecondMoments> exact_second_moments(const PointArray& points, IndexTriangles triangles,
                                                const std::atomic<bool>* cancel = nullptr);

/// Sum of the areas of the triangles, in squared coordinate units; infinite beyond the range of doubles. Exactness:
/// rounded once if the area of each triangle is a double (or any other multiple of a power of two). Otherwise the sum
/// has a relative error below 2^-90 before it is rounded. Errors: interrupted. Cost: linear, some tens of nanoseconds
/// per triangle of doubles between 2^-100 and 2^200; some 400 where the result is very close to the middle between two
/// doubles (counted in `exact_counters().filter_failures`), and for other doubles.
Result<double> nearest_area(const PointArray& points, IndexTriangles triangles,
                            const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
