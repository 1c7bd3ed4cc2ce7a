#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "algebra3d/exact/point.h"

namespace algebra3d {

/// Counts of this process that show what exactness costs; each thread adds to its own and they are summed on reading.
struct ExactCounters {
  std::uint64_t calls = 0;            ///< predicate calls
  std::uint64_t filter_failures = 0;  ///< calls that the floating-point filter could not decide
  std::uint64_t big_fallbacks = 0;    ///< calls that came down to rationals or big integers
  std::uint64_t heap_rationals = 0;   ///< rationals made that did not fit 64 bits
};
ExactCounters exact_counters();
void reset_exact_counters();

/// Coordinate plane onto which `orient2d` projects: the two axes kept, in the order of a right-handed system.
enum class Projection : std::uint8_t { yz, zx, xy };

using TriangleRef = std::array<PointRef, 3>;

/// Sign of the volume of the tetrahedron abcd: 1 if d lies on the side of plane abc to which the normal (b-a)x(c-a)
/// points, 0 if the four are coplanar, -1 otherwise. Exact for all finite input, subnormal and huge values included.
/// Cost: about ten nanoseconds when the filter decides. Source: [shewchuk1997], [bronnimann2001].
int orient3d(PointRef a, PointRef b, PointRef c, PointRef d);
/// Sign of the area of the projected triangle: 1 if it turns counter-clockwise. Exact.
int orient2d(Projection plane, PointRef a, PointRef b, PointRef c);

/// Compare one exact coordinate (axis 0, 1, 2), or all lexicographically.
std::strong_ordering compare(std::size_t axis, PointRef a, PointRef b);
std::strong_ordering compare(PointRef a, PointRef b);
bool equal(PointRef a, PointRef b);
/// True if the three lie on a line (equal points included).
bool collinear(PointRef a, PointRef b, PointRef c);
/// A projection in which the triangle keeps a positive area: its area's sign there is exact and not 0. Requires that
/// the three are not collinear.
Projection dominant_projection(PointRef a, PointRef b, PointRef c);

/// What two closed sets have in common: nothing, one point, a segment, or a part of positive area.
enum class Contact : std::uint8_t { none, point, segment, area };

/// Common part of two segments (collinear overlap included). Neither may be a single point.
Contact intersect_segments(PointRef a, PointRef b, PointRef c, PointRef d);
/// Common part of segment pq (p != q) and a triangle that is not degenerate.
Contact intersect_segment_triangle(PointRef p, PointRef q, const TriangleRef& triangle);
/// Common part of two triangles that are not degenerate; shared corners and edges count like any other common point.
/// Source: [guigue2003] for the order of the tests; decided by signs of orient3d and orient2d alone.
Contact intersect_triangles(const TriangleRef& s, const TriangleRef& t);

}  // namespace algebra3d
