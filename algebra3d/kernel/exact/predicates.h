#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d {

using TriangleRef = std::array<PointRef, 3>;

namespace detail {
// Decide what the filters of the inline functions below leave undecided.
int decide_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int decide_orient2d(Projection plane, const Vec3& a, const Vec3& b, const Vec3& c);
int orient3d_of_rationals(const PointRef& a, const PointRef& b, const PointRef& c, const PointRef& d);
int orient2d_of_rationals(Projection plane, const PointRef& a, const PointRef& b, const PointRef& c);
}  // namespace detail

/// Sign of the volume of the tetrahedron abcd: 1 if d lies on the side of plane abc to which the normal (b-a)x(c-a)
/// points, 0 if the four are coplanar, -1 otherwise. Exact for all finite input, subnormal and huge values included.
/// Cost: about five nanoseconds when the filter decides; some fifty if not and the coordinates of each axis are
/// multiples of one power of two within 60 bits; half a microsecond for other doubles between 2^-200 and 2^300;
/// microseconds beyond that range and for exact points that intervals do not decide. Source: [shewchuk1997],
/// [bronnimann2001].
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

/// Compare one exact coordinate (axis 0, 1, 2), or all lexicographically.
std::strong_ordering compare(std::size_t axis, PointRef a, PointRef b);
std::strong_ordering compare(PointRef a, PointRef b);
bool equal(PointRef a, PointRef b);
/// True if the three lie on a line (equal points included).
bool collinear(PointRef a, PointRef b, PointRef c);
/// A projection in which the triangle is not degenerate. Requires that the three points are not collinear.
Projection dominant_projection(const PointRef& a, const PointRef& b, const PointRef& c);
/// A projection and the sign of the triangle's area in it.
struct ProjectedTurn {
  Projection projection;
  int sign;
};
ProjectedTurn dominant_turn(const TriangleRef& triangle);

/// The kind of the intersection of two closed sets: empty, a point, a segment, or a part of positive area.
enum class Contact : std::uint8_t { none, point, segment, area };

/// The intersection of two segments (collinear overlap included). Neither may be a single point.
Contact intersect_segments(PointRef a, PointRef b, PointRef c, PointRef d);
/// The intersection of segment pq (p != q) and a triangle that is not degenerate.
Contact intersect_segment_triangle(PointRef p, PointRef q, const TriangleRef& triangle);
/// The intersection of two triangles that are not degenerate; shared corners and edges count as intersections. Cost:
/// three to eight calls of orient3d for triangles in different planes, three if one lies on one side of the other's
/// plane; some twenty of orient2d in a common plane. Source: [guigue2003] for the order of the tests, which use
/// orient3d, orient2d and comparisons only.
Contact intersect_triangles(const TriangleRef& s, const TriangleRef& t);
/// The intersection of two triangles in one plane.
Contact intersect_coplanar_triangles(const TriangleRef& s, const TriangleRef& t);

/// The intersection of two triangles, and where the corners of each lie relative to the plane of the other: all 0 if
/// they are coplanar.
struct SidedContact {
  Contact kind = Contact::none;
  std::array<int, 3> s_sides{};  ///< of the corners of s; meaningless if the kind is `none`
  std::array<int, 3> t_sides{};

  bool is_coplanar() const { return kind != Contact::none && t_sides == std::array<int, 3>{}; }
};
/// Like `intersect_triangles`, but also returns the sides that it finds on the way.
SidedContact contact_of_triangles(const TriangleRef& s, const TriangleRef& t);
/// As above, where the sides of the plane of s on which corners of t lie are known; detail::kUndecided for unknown
/// ones.
SidedContact contact_of_triangles(const TriangleRef& s, const TriangleRef& t, const std::array<int, 3>& known_t_sides);
/// True if p lies on the triangle, its edges and corners included. It must not be degenerate. Exact. Cost: one orient3d
/// if p is not in its plane.
bool is_on_triangle(PointRef p, const TriangleRef& triangle);
/// True if p lies on the segment ab, ends included.
bool is_on_segment(PointRef p, PointRef a, PointRef b);

/// True if the triangles (shared, s1, s2) and (shared, t1, t2) share more than the corner `shared`, that is, a segment
/// or an area. Neither may be degenerate. Cost: two to four calls of orient3d unless they are coplanar.
bool meet_beyond_shared_vertex(PointRef shared, PointRef s1, PointRef s2, PointRef t1, PointRef t2);
/// True if the triangles (e0, e1, s) and (e0, e1, t) share more than the edge, that is, an area: they are coplanar and
/// on the same side of the edge. Neither may be degenerate. Cost: one orient3d unless coplanar.
bool overlap_beyond_shared_edge(PointRef e0, PointRef e1, PointRef s, PointRef t);

/// Compares b and c in radial order around the directed edge e0 -> e1. Each point off the edge's line spans a
/// half-plane with it. The angle of a point, in [0, 360) degrees, is that from the half-plane of `origin` to its own,
/// right-handed about e1 - e0. Requires e0 != e1 and no point on the line. Exact. For a fixed edge and origin a strict
/// weak order, for sorting the faces at an edge by their third corners.
std::weak_ordering compare_around_edge(PointRef e0, PointRef e1, PointRef origin, PointRef b, PointRef c);

}  // namespace algebra3d
