// Common parts of segments and triangles. All decisions are signs of orient3d and orient2d or comparisons of exact
// coordinates; no intersection point is ever computed.

#include <compare>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

namespace {

using Signs = std::array<int, 3>;

constexpr std::size_t next(std::size_t corner) {
  return corner == 2 ? 0 : corner + 1;
}

bool all_equal_and_not_zero(const Signs& signs) {
  return signs[0] != 0 && signs[0] == signs[1] && signs[0] == signs[2];
}

// For signs some of which are kUndecided.
bool certainly_all_equal(const Signs& signs) {
  return signs[0] != detail::kUndecided && all_equal_and_not_zero(signs);
}

bool all_zero(const Signs& signs) {
  return signs[0] == 0 && signs[1] == 0 && signs[2] == 0;
}

// The sides of the plane of `base` on which the corners of `triangle` lie, where the filter for doubles decides them.
Signs filtered_sides(const TriangleRef& base, const TriangleRef& triangle) {
  const auto& [a, b, c] = base;
  detail::count_calls(3);
  Signs sides{detail::kUndecided, detail::kUndecided, detail::kUndecided};
  if (!a.is_double() || !b.is_double() || !c.is_double()) return sides;
  const detail::PlaneFilter filter(a.approx, b.approx, c.approx);
  for (std::size_t i = 0; i < 3; ++i)
    if (triangle[i].is_double()) sides[i] = filter.side(triangle[i].approx);
  return sides;
}

// Decides the sides that are undecided.
void decide_sides(const TriangleRef& base, const TriangleRef& triangle, Signs& sides) {
  const auto& [a, b, c] = base;
  const bool has_double_base = a.is_double() && b.is_double() && c.is_double();
  for (std::size_t i = 0; i < 3; ++i) {
    if (sides[i] != detail::kUndecided) continue;
    const PointRef& d = triangle[i];
    sides[i] = has_double_base && d.is_double() ? detail::decide_orient3d(a.approx, b.approx, c.approx, d.approx)
                                                : detail::orient3d_of_rationals(a, b, c, d);
  }
}

// ---- on one line, where lexicographic order is the order along the line

Contact point_on_collinear_segment(const PointRef& p, const PointRef& a, const PointRef& b) {
  const auto to_a = compare(p, a);
  const auto to_b = compare(p, b);
  const bool between = (std::is_gteq(to_a) && std::is_lteq(to_b)) || (std::is_lteq(to_a) && std::is_gteq(to_b));
  return between ? Contact::point : Contact::none;
}

Contact collinear_segments(PointRef a, PointRef b, PointRef c, PointRef d) {
  if (std::is_gt(compare(a, b))) std::swap(a, b);
  if (std::is_gt(compare(c, d))) std::swap(c, d);
  const PointRef& from = std::is_lt(compare(a, c)) ? c : a;
  const PointRef& to = std::is_lt(compare(b, d)) ? b : d;
  const auto order = compare(from, to);
  if (std::is_eq(order)) return Contact::point;
  return std::is_lt(order) ? Contact::segment : Contact::none;
}

// ---- in one plane, seen in a projection that keeps it a plane

// A triangle that turns counter-clockwise in the projection.
TriangleRef counterclockwise(const TriangleRef& triangle, Projection plane) {
  if (orient2d(plane, triangle[0], triangle[1], triangle[2]) > 0) return triangle;
  return {triangle[0], triangle[2], triangle[1]};
}

// The intersection of two triangles if the line of some edge of the first separates them (it may touch the second);
// `area` if no edge does, which is then the answer only if no edge of the second does either.
Contact contact_across_edges(const TriangleRef& triangle, const TriangleRef& other, Projection plane) {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const PointRef& from = triangle[edge];
    const PointRef& to = triangle[next(edge)];
    std::array<const PointRef*, 3> on_line{};
    std::size_t on_line_count = 0;
    bool separates = true;
    for (std::size_t corner = 0; corner < 3 && separates; ++corner) {
      const int side = orient2d(plane, from, to, other[corner]);
      separates = side <= 0;
      if (side == 0) on_line[on_line_count++] = &other[corner];
    }
    if (!separates) continue;
    if (on_line_count == 0) return Contact::none;
    if (on_line_count == 1) return point_on_collinear_segment(*on_line[0], from, to);
    return collinear_segments(*on_line[0], *on_line[1], from, to);
  }
  return Contact::area;
}

Contact coplanar_segment_triangle(const PointRef& p, const PointRef& q, const TriangleRef& triangle) {
  const Projection plane = dominant_projection(triangle[0], triangle[1], triangle[2]);
  const TriangleRef turned = counterclockwise(triangle, plane);
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const PointRef& from = turned[edge];
    const PointRef& to = turned[next(edge)];
    const int side_p = orient2d(plane, from, to, p);
    const int side_q = orient2d(plane, from, to, q);
    if (side_p > 0 || side_q > 0) continue;
    if (side_p == 0 && side_q == 0) return collinear_segments(p, q, from, to);
    if (side_p == 0) return point_on_collinear_segment(p, from, to);
    if (side_q == 0) return point_on_collinear_segment(q, from, to);
    return Contact::none;
  }
  Signs sides{};
  for (std::size_t corner = 0; corner < 3; ++corner) sides[corner] = orient2d(plane, p, q, turned[corner]);
  if (all_equal_and_not_zero(sides)) return Contact::none;
  // The line of the segment passes through at most one corner: an edge on it was found above.
  for (std::size_t corner = 0; corner < 3; ++corner)
    if (sides[corner] == 0 && sides[next(corner)] == sides[next(next(corner))])
      return point_on_collinear_segment(turned[corner], p, q);
  return Contact::segment;
}

// ---- triangles in different planes

// One triangle as the line in which the two planes meet sees it: corner `alone` lies strictly higher over the other's
// plane than both others, after turning the other triangle over if `is_below`.
struct Apex {
  std::size_t alone = 0;
  bool is_below = false;
  bool touches_in_corner = false;  // the triangle meets the other's plane in that corner only
};

// `heights` are neither all 0 nor all equal.
Apex find_apex(const Signs& heights) {
  for (std::size_t i = 0; i < 3; ++i) {
    const int h = heights[i], h1 = heights[next(i)], h2 = heights[next(next(i))];
    if (h > 0 && h1 <= 0 && h2 <= 0) return {i, false, false};
    if (h < 0 && h1 >= 0 && h2 >= 0) return {i, true, false};
    if (h == 0 && h1 == h2) return {i, h1 > 0, true};
  }
  return {};  // not reached: one of the three holds for some corner
}

// Source: [guigue2003], section 3. Each triangle meets the other's plane in an interval of the common line, from edge
// (0, 1) to edge (0, 2) of s and from edge (0, 2) to edge (0, 1) of t, once the apexes are first and up. The sign of
// the tetrahedron of two edges gives the order of the places where they meet the line.
Contact intervals_on_common_line(const TriangleRef& s, const Signs& s_heights, const TriangleRef& t,
                                 const Signs& t_heights) {
  const Apex s_apex = find_apex(s_heights);
  const Apex t_apex = find_apex(t_heights);
  const PointRef &s0 = s[s_apex.alone], &t0 = t[t_apex.alone];
  const PointRef *s1 = &s[next(s_apex.alone)], *s2 = &s[next(next(s_apex.alone))];
  const PointRef *t1 = &t[next(t_apex.alone)], *t2 = &t[next(next(t_apex.alone))];
  if (s_apex.is_below) std::swap(t1, t2);
  if (t_apex.is_below) std::swap(s1, s2);
  const int s_begin_after_t_end = orient3d(s0, *s1, t0, *t1);
  if (s_begin_after_t_end > 0) return Contact::none;
  const int s_end_after_t_begin = orient3d(s0, *s2, t0, *t2);
  if (s_end_after_t_begin < 0) return Contact::none;
  const bool in_point =
      s_apex.touches_in_corner || t_apex.touches_in_corner || s_begin_after_t_end == 0 || s_end_after_t_begin == 0;
  return in_point ? Contact::point : Contact::segment;
}

// ---- round a corner or an edge

// In the plane: whether direction v->x lies in the closed cone at v from a counter-clockwise to b, less than 180
// degrees.
bool in_cone(Projection plane, const PointRef& v, const PointRef& a, const PointRef& b, const PointRef& x) {
  return orient2d(plane, v, a, x) >= 0 && orient2d(plane, v, x, b) >= 0;
}

bool coplanar_cones_meet(const PointRef& v, PointRef s1, PointRef s2, PointRef t1, PointRef t2) {
  const Projection plane = dominant_projection(v, s1, s2);
  if (orient2d(plane, v, s1, s2) < 0) std::swap(s1, s2);
  if (orient2d(plane, v, t1, t2) < 0) std::swap(t1, t2);
  // Both are less than 180 degrees wide, so a common part is one cone, which begins where one of the two begins.
  return in_cone(plane, v, s1, s2, t1) || in_cone(plane, v, t1, t2, s1);
}

// For x in the plane of e0, e1, a: whether it lies on the same side of the line e0 e1 as a.
bool on_same_side(const PointRef& e0, const PointRef& e1, const PointRef& a, const PointRef& x) {
  const Projection plane = dominant_projection(e0, e1, a);
  return orient2d(plane, e0, e1, a) == orient2d(plane, e0, e1, x);
}

// Angle of x from the half-plane of `origin`: 0: none, 1: below 180 degrees, 2: 180 degrees, 3: more.
int half_turn(const PointRef& e0, const PointRef& e1, const PointRef& origin, const PointRef& x) {
  const int side = orient3d(e0, e1, origin, x);
  if (side != 0) return side > 0 ? 1 : 3;
  return on_same_side(e0, e1, origin, x) ? 0 : 2;
}

}  // namespace

Contact intersect_segments(PointRef a, PointRef b, PointRef c, PointRef d) {
  if (orient3d(a, b, c, d) != 0) return Contact::none;
  const bool c_on_line = collinear(a, b, c);
  if (c_on_line && collinear(a, b, d)) return collinear_segments(a, b, c, d);
  const Projection plane = dominant_projection(a, b, c_on_line ? d : c);
  if (orient2d(plane, a, b, c) * orient2d(plane, a, b, d) > 0) return Contact::none;
  return orient2d(plane, c, d, a) * orient2d(plane, c, d, b) > 0 ? Contact::none : Contact::point;
}

Contact intersect_segment_triangle(PointRef p, PointRef q, const TriangleRef& triangle) {
  const auto& [a, b, c] = triangle;
  const int side_p = orient3d(a, b, c, p);
  const int side_q = orient3d(a, b, c, q);
  if (side_p * side_q > 0) return Contact::none;
  if (side_p == 0 && side_q == 0) return coplanar_segment_triangle(p, q, triangle);
  // The line crosses the plane in one point, which is in the triangle if the line passes all edges on one side.
  const int ab = orient3d(p, q, a, b);
  const int bc = orient3d(p, q, b, c);
  if (ab * bc < 0) return Contact::none;
  const int ca = orient3d(p, q, c, a);
  return ab * ca < 0 || bc * ca < 0 ? Contact::none : Contact::point;
}

// Two convex polygons have no common inner point only if the line of an edge of one of them keeps them apart.
Contact intersect_coplanar_triangles(const TriangleRef& s, const TriangleRef& t) {
  const Projection plane = dominant_projection(s[0], s[1], s[2]);
  const TriangleRef turned_s = counterclockwise(s, plane);
  const TriangleRef turned_t = counterclockwise(t, plane);
  const Contact contact = contact_across_edges(turned_s, turned_t, plane);
  return contact != Contact::area ? contact : contact_across_edges(turned_t, turned_s, plane);
}

Contact intersect_triangles(const TriangleRef& s, const TriangleRef& t) {
  return contact_of_triangles(s, t).kind;
}

SidedContact contact_of_triangles(const TriangleRef& s, const TriangleRef& t) {
  return contact_of_triangles(s, t, filtered_sides(s, t));
}

// Filters first: of two triangles that are apart one of the planes mostly shows it, where the other one may need an
// exact answer.
SidedContact contact_of_triangles(const TriangleRef& s, const TriangleRef& t, const std::array<int, 3>& known_t_sides) {
  SidedContact contact{Contact::none, {}, known_t_sides};
  Signs &s_sides = contact.s_sides, &t_sides = contact.t_sides;
  if (certainly_all_equal(t_sides)) return contact;
  s_sides = filtered_sides(t, s);
  if (certainly_all_equal(s_sides)) return contact;
  decide_sides(s, t, t_sides);
  if (all_equal_and_not_zero(t_sides)) return contact;
  if (all_zero(t_sides)) {
    contact.kind = intersect_coplanar_triangles(s, t);
    s_sides = {};
    return contact;
  }
  decide_sides(t, s, s_sides);
  if (!all_equal_and_not_zero(s_sides)) contact.kind = intervals_on_common_line(s, s_sides, t, t_sides);
  return contact;
}

bool is_on_triangle(PointRef p, const TriangleRef& triangle) {
  const auto& [a, b, c] = triangle;
  if (orient3d(a, b, c, p) != 0) return false;
  const auto [plane, turn] = dominant_turn(triangle);
  return orient2d(plane, a, b, p) * turn >= 0 && orient2d(plane, b, c, p) * turn >= 0 &&
         orient2d(plane, c, a, p) * turn >= 0;
}

bool is_on_segment(PointRef p, PointRef a, PointRef b) {
  return point_on_collinear_segment(p, a, b) == Contact::point && collinear(p, a, b);
}

bool meet_beyond_shared_vertex(PointRef shared, PointRef s1, PointRef s2, PointRef t1, PointRef t2) {
  const int t1_height = orient3d(shared, s1, s2, t1);
  const int t2_height = orient3d(shared, s1, s2, t2);
  if (t1_height * t2_height > 0) return false;
  if (t1_height == 0 && t2_height == 0) return coplanar_cones_meet(shared, s1, s2, t1, t2);
  const int s1_height = orient3d(shared, t1, t2, s1);
  const int s2_height = orient3d(shared, t1, t2, s2);
  if (s1_height * s2_height > 0) return false;
  // Each triangle leaves the corner along the line in which the planes meet, one way or the other. With normals m of s
  // and n of t, the first goes along m x n if s1 is not below t's plane and s2 not above; the second along m x n if t1
  // is not above s's plane and t2 not below.
  return (s1_height > s2_height) == (t1_height < t2_height);
}

bool overlap_beyond_shared_edge(PointRef e0, PointRef e1, PointRef s, PointRef t) {
  return orient3d(e0, e1, s, t) == 0 && on_same_side(e0, e1, s, t);
}

std::weak_ordering compare_around_edge(PointRef e0, PointRef e1, PointRef origin, PointRef b, PointRef c) {
  const int turn_b = half_turn(e0, e1, origin, b);
  const int turn_c = half_turn(e0, e1, origin, c);
  if (turn_b != turn_c) return turn_b <=> turn_c;
  if (turn_b == 0 || turn_b == 2) return std::weak_ordering::equivalent;
  return 0 <=> orient3d(e0, e1, b, c);
}

}  // namespace algebra3d
