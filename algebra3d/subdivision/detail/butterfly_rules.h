#pragma once

#include <cstdint>

#include "algebra3d/subdivision/detail/triangle_split.h"

namespace algebra3d::subdivision {

/// The corner across the edge of `h`, seen from its triangle; where none is, a virtual one: the third corner of the
/// triangle reflected across the edge. Source: [zorin1996].
inline Vec3 point_across(const TriangleView& view, std::uint32_t h) {
  const std::uint32_t o = view.opposite(h);
  if (o != kNone) return view.origin_point(view.prev(o));
  return (view.origin_point(h) + view.target_point(h)) - view.origin_point(view.prev(h));
}

/// The four-point rule on a boundary edge, which depends on the boundary alone.
inline Vec3 boundary_edge_point(const TriangleView& view, std::uint32_t h) {
  const Vec3 ends = view.origin_point(h) + view.target_point(h);
  const Vec3 beyond =
      view.point(view.boundary_predecessor(view.origin(h))) + view.target_point(view.outgoing(view.target(h)));
  return 0.5625 * ends - 0.0625 * beyond;
}

/// The rule of eight points on an edge between two triangles, with tension 1/16.
inline Vec3 butterfly_edge_point(const TriangleView& view, std::uint32_t h) {
  const std::uint32_t o = view.opposite(h);
  if (o == kNone) return boundary_edge_point(view, h);
  const std::uint32_t next = view.next(h), prev = view.prev(h), o_next = view.next(o), o_prev = view.prev(o);
  const Vec3 ends = view.origin_point(h) + view.origin_point(o);
  const Vec3 wings = view.origin_point(prev) + view.origin_point(o_prev);
  const Vec3 far =
      (point_across(view, next) + point_across(view, prev)) + (point_across(view, o_next) + point_across(view, o_prev));
  return (0.5 * ends + 0.125 * wings) - 0.0625 * far;
}

}  // namespace algebra3d::subdivision
