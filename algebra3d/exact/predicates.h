#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "algebra3d/exact/counters.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/exact/predicates_filter.h"

namespace algebra3d {

using TriangleRef = std::array<PointRef, 3>;

namespace detail {
// The ways out of the inline functions below, for what the filter leaves open.
int decide_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int decide_orient2d(Projection plane, const Vec3& a, const Vec3& b, const Vec3& c);
int orient3d_of_rationals(const PointRef& a, const PointRef& b, const PointRef& c, const PointRef& d);
int orient2d_of_rationals(Projection plane, const PointRef& a, const PointRef& b, const PointRef& c);
}  // namespace detail

/// Sign of the volume of the tetrahedron abcd: 1 if d lies on the side of plane abc to which the normal (b-a)x(c-a)
/// points, 0 if the four are coplanar, -1 otherwise. Exact for all finite input, subnormal and huge values included.
/// Cost: about five nanoseconds when the filter decides; some fifty where it does not and the coordinates of each axis
/// are multiples of one power of two not 60 bits apart; half a microsecond for other doubles between 2^-200 and 2^300.
/// Rationals serve beyond that range and for points that are no doubles, if intervals do not decide: microseconds.
/// Source: [shewchuk1997], [bronnimann2001].
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  detail::count_call();
  const int sign = detail::filter_orient3d(a, b, c, d);
  return sign != detail::kUndecided ? sign : detail::decide_orient3d(a, b, c, d);
}
inline int orient3d(const PointRef& a, const PointRef& b, const PointRef& c, const PointRef& d) {
  if (a.is_double() && b.is_double() && c.is_double() && d.is_double()) [[likely]]
    return orient3d(a.approx, b.approx, c.approx, d.approx);
  detail::count_call();
  return detail::orient3d_of_rationals(a, b, c, d);
}

/// Sign of the area of the projected triangle: 1 if it turns counter-clockwise. Exact. Cost: as `orient3d`, or less.
inline int orient2d(Projection plane, const Vec3& a, const Vec3& b, const Vec3& c) {
  detail::count_call();
  const int sign = detail::filter_orient2d(plane, a, b, c);
  return sign != detail::kUndecided ? sign : detail::decide_orient2d(plane, a, b, c);
}
inline int orient2d(Projection plane, const PointRef& a, const PointRef& b, const PointRef& c) {
  if (a.is_double() && b.is_double() && c.is_double()) [[likely]]
    return orient2d(plane, a.approx, b.approx, c.approx);
  detail::count_call();
  return detail::orient2d_of_rationals(plane, a, b, c);
}

/// Sides of the plane of `base`, which is not degenerate, on which the corners of `triangle` lie: three times orient3d,
/// with what belongs to the plane done once.
std::array<int, 3> sides_of_plane(const TriangleRef& base, const TriangleRef& triangle);

/// Compare one exact coordinate (axis 0, 1, 2), or all lexicographically.
std::strong_ordering compare(std::size_t axis, PointRef a, PointRef b);
std::strong_ordering compare(PointRef a, PointRef b);
bool equal(PointRef a, PointRef b);
/// True if the three lie on a line (equal points included).
bool collinear(PointRef a, PointRef b, PointRef c);
/// A projection in which the triangle keeps a positive area: its area's sign there is exact and not 0. Requires that
/// the three are not collinear.
Projection dominant_projection(const PointRef& a, const PointRef& b, const PointRef& c);
/// The same, and the sign of the area there.
struct ProjectedTurn {
  Projection projection;
  int sign;
};
ProjectedTurn dominant_turn(const TriangleRef& triangle);

/// What two closed sets have in common: nothing, one point, a segment, or a part of positive area.
enum class Contact : std::uint8_t { none, point, segment, area };

/// Common part of two segments (collinear overlap included). Neither may be a single point.
Contact intersect_segments(PointRef a, PointRef b, PointRef c, PointRef d);
/// Common part of segment pq (p != q) and a triangle that is not degenerate.
Contact intersect_segment_triangle(PointRef p, PointRef q, const TriangleRef& triangle);
/// Common part of two triangles that are not degenerate; shared corners and edges count like any other common point.
/// Cost: three to eight calls of orient3d for triangles in different planes, three if one lies on one side of the
/// other's plane; some twenty of orient2d in a common plane.
/// Source: [guigue2003] for the order of the tests; decided by signs of orient3d and orient2d and by comparison alone.
Contact intersect_triangles(const TriangleRef& s, const TriangleRef& t);

/// True if the triangles (shared, s1, s2) and (shared, t1, t2) have more in common than the corner `shared`; it is then
/// a segment or an area. Neither may be degenerate. Cost: two to four calls of orient3d unless they are coplanar.
bool meet_beyond_shared_vertex(PointRef shared, PointRef s1, PointRef s2, PointRef t1, PointRef t2);
/// True if the triangles (e0, e1, s) and (e0, e1, t) have more in common than the edge, which is then an area: they lie
/// in one plane and on the same side of the edge. Neither may be degenerate. Cost: one orient3d unless coplanar.
bool overlap_beyond_shared_edge(PointRef e0, PointRef e1, PointRef s, PointRef t);

/// Radial order round the directed edge e0 -> e1. Each point off its line spans a half-plane with it; the angle of a
/// point is that by which the half-plane of `origin` has to turn counter-clockwise (as seen by someone towards whom the
/// edge points: right-handed about e1 - e0) to arrive at the point's half-plane, in [0, 360) degrees. Compares the
/// angles of b and c. Requires e0 != e1 and no point on the line. Exact.
/// For a fixed edge and origin this is a strict weak order, fit for sorting the faces at an edge by their third
/// corners.
std::weak_ordering compare_around_edge(PointRef e0, PointRef e1, PointRef origin, PointRef b, PointRef c);
/// True if the half-plane of a, turning as above, passes that of c strictly after its start and strictly before it
/// arrives at that of b. If a and b span the same half-plane, the turn is a whole one. Same requirements.
bool in_counterclockwise_order(PointRef e0, PointRef e1, PointRef a, PointRef b, PointRef c);

}  // namespace algebra3d
