#pragma once

#include "algebra3d/kernel/subdivision/detail/triangle_split.h"

namespace algebra3d::subdivision {

/// The corner across the edge of `h`, seen from its triangle; where none is, a virtual one: the third corner of the
/// triangle reflected across the edge. Source: [zorin1996].
inline Vec3 point_across(const TriangleView& view, HalfedgeId h) {
  const HalfedgeId o = view.opposite(h);
  if (o.is_valid()) return view.origin_point(view.prev(o));
  return (view.origin_point(h) + view.target_point(h)) - view.origin_point(view.prev(h));
}

/// The four-point rule on a boundary edge, which depends on the boundary alone.
inline Vec3 boundary_edge_point(const TriangleView& view, HalfedgeId h) {
  const Vec3 ends = view.origin_point(h) + view.target_point(h);
  const Vec3 beyond =
      view.point(view.boundary_predecessor(view.origin(h))) + view.target_point(view.outgoing(view.target(h)));
  return 0.5625 * ends - 0.0625 * beyond;
}

/// The rule of eight points on an edge between two triangles, with tension 1/16.
inline Vec3 butterfly_edge_point(const TriangleView& view, HalfedgeId h) {
  const HalfedgeId o = view.opposite(h);
  if (o.is_none()) return boundary_edge_point(view, h);
  const HalfedgeId next = view.next(h), prev = view.prev(h), o_next = view.next(o), o_prev = view.prev(o);
  const Vec3 ends = view.origin_point(h) + view.origin_point(o);
  const Vec3 wings = view.origin_point(prev) + view.origin_point(o_prev);
  const Vec3 far =
      (point_across(view, next) + point_across(view, prev)) + (point_across(view, o_next) + point_across(view, o_prev));
  return (0.5 * ends + 0.125 * wings) - 0.0625 * far;
}

/// The rule on an edge that leads inward from a boundary vertex with three triangles, which `h` leaves, to an interior
/// vertex with six: 3/8 and 5/8 of these; of the third corners of the two triangles 1/16 of that on the boundary and
/// 3/16 of the other; beyond them -1/16, -1/16 and -1/8. Reproduces quadratic functions. Source: [zorin2000],
/// chapter 4.
inline Vec3 inward_edge_point(const TriangleView& view, HalfedgeId h) {
  const HalfedgeId o = view.opposite(h), next = view.next(h), prev = view.prev(h);
  const HalfedgeId o_next = view.next(o), o_prev = view.prev(o);
  const bool is_left_outer = view.is_boundary(prev);
  const Vec3 &left = view.origin_point(prev), &right = view.origin_point(o_prev);
  const Vec3 beyond_left = point_across(view, next), beyond_right = point_across(view, o_prev);
  // The other neighbour of the vertex on the boundary.
  const Vec3 far = is_left_outer ? point_across(view, o_next) : point_across(view, prev);
  const Vec3 &outer = is_left_outer ? left : right, &inner = is_left_outer ? right : left;
  const Vec3& beyond_outer = is_left_outer ? beyond_left : beyond_right;
  const Vec3& beyond_inner = is_left_outer ? beyond_right : beyond_left;
  return (0.375 * view.origin_point(h) + 0.625 * view.target_point(h)) +
         (0.0625 * (outer - far - beyond_outer) + (0.1875 * inner - 0.125 * beyond_inner));
}

/// The rule on an edge inside between two boundary vertices with three triangles each. If a triangle beside it has two
/// boundary edges: 1/2 of the ends, 1/4 of the third corner on the other side, -1/8 of the two beyond it; otherwise the
/// middle. Reproduces quadratic functions in the first case. Source: [zorin2000], chapter 4.
inline Vec3 cutting_edge_point(const TriangleView& view, HalfedgeId h) {
  const Vec3 middle = 0.5 * (view.origin_point(h) + view.target_point(h));
  const auto is_ear = [&](HalfedgeId side) {
    return view.is_boundary(view.next(side)) && view.is_boundary(view.prev(side));
  };
  const HalfedgeId o = view.opposite(h), wide = is_ear(h) ? o : h;
  if (is_ear(h) == is_ear(o)) return middle;
  return (middle + 0.25 * view.origin_point(view.prev(wide))) -
         0.125 * (point_across(view, view.next(wide)) + point_across(view, view.prev(wide)));
}

/// The rule of Modified Butterfly on an edge between regular vertices.
inline Vec3 regular_edge_point(const TriangleView& view, HalfedgeId h) {
  const HalfedgeId o = view.opposite(h);
  if (o.is_none()) return boundary_edge_point(view, h);
  const bool is_origin_outer = view.is_boundary_vertex(view.origin(h));
  const bool is_target_outer = view.is_boundary_vertex(view.target(h));
  if (is_origin_outer && is_target_outer) return cutting_edge_point(view, h);
  if (is_origin_outer || is_target_outer) return inward_edge_point(view, is_origin_outer ? h : o);
  return butterfly_edge_point(view, h);
}

}  // namespace algebra3d::subdivision
