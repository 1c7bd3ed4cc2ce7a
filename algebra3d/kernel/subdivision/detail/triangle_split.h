#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "algebra3d/kernel/subdivision/detail/edge_enumeration.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {

using TriangleView = MeshView<3>;

/// The division of each triangle into four at new vertices on its edges. Triangle 4f + i has corner i of triangle f and
/// the two edge vertices beside it, in this order: corner, edge vertex after it, edge vertex before it; triangle 4f + 3
/// has the three edge vertices. So of a half-edge h = 3f + i, the half that begins at its origin is 12f + 3i, and the
/// half that ends at its target belongs to the next corner.
class TriangleSplit {
 public:
  static std::uint32_t first_half(std::uint32_t h) { return 12 * (h / 3) + 3 * (h % 3); }
  static std::uint32_t second_half(std::uint32_t h) {
    return first_half(TriangleLayout::next(HalfedgeId(h)).index()) + 2;
  }
  /// The half-edge from the edge vertex of h to the one before it, in the triangle at the origin of h.
  static std::uint32_t cut(std::uint32_t h) { return first_half(h) + 1; }
  /// The half-edge of that edge in the middle triangle, where half-edge 12f + 9 + i leaves the edge vertex of half-edge
  /// i.
  static std::uint32_t middle(std::uint32_t h) { return 12 * (h / 3) + 9 + h % 3; }

  /// The outgoing half-edge of the vertex on the edge of h, which is the first of the edge.
  static std::uint32_t outgoing_of_edge_vertex(std::uint32_t h, bool is_boundary) {
    if (is_boundary) return second_half(h);
    // The lowest that leaves it; the other triangle of the edge has higher ones.
    return std::min(cut(h), second_half(h));
  }

  /// Writes the four triangles of f. `edge_vertices` has the vertex of each half-edge.
  static void write_faces(const TriangleView& view, std::uint32_t f, const std::uint32_t* edge_vertices,
                          RefinedMesh& refined) {
    for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const std::uint32_t before = view.prev(h), start = first_half(h);
      refined.corners[start] = view.origin(h);
      refined.corners[start + 1] = edge_vertices[h];
      refined.corners[start + 2] = edge_vertices[before];
      refined.corners[middle(h)] = edge_vertices[h];
      // The cut at the corner runs from the edge vertex of h to that before it; in the middle it runs back.
      refined.opposites[cut(h)] = middle(before);
      refined.opposites[middle(before)] = cut(h);
      const std::uint32_t o = view.opposite(h);
      refined.opposites[start] = o == kNone ? kNone : second_half(o);
      refined.opposites[second_half(h)] = o == kNone ? kNone : first_half(o);
    }
  }
};

/// The mesh with each triangle divided into four. edge_point(h, e) is the new vertex on edge number e, whose first
/// half-edge is h; vertex_point(v) is the new place of a vertex that is not isolated. Error: interrupted.
template <typename EdgePoint, typename VertexPoint>
Result<PolygonMesh> split_triangles(const StepInput& input, const EdgePoint& edge_point,
                                    const VertexPoint& vertex_point) {
  const Monitor& monitor = input.monitor;
  const TriangleView view(input.mesh);
  const std::uint32_t vertex_count = view.vertex_count(), halfedge_count = view.halfedge_count();
  const Stage stage(monitor, input.what,
                    2 * block_count(halfedge_count) + block_count(view.face_count()) + block_count(vertex_count));
  const EdgeEnumeration edges(view, Edges::all, stage);
  A3D_TRY(monitor.check());
  RefinedMesh refined(std::size_t{vertex_count} + edges.count(), std::size_t{4} * halfedge_count);
  LargeVector<std::uint32_t> edge_vertices;
  edge_vertices.resize(halfedge_count);
  edges.for_each(stage, [&](std::uint32_t h, std::uint32_t e) {
    const std::uint32_t v = vertex_count + e;
    edge_vertices[h] = v;
    if (!view.is_boundary(h)) edge_vertices[view.opposite(h)] = v;
    refined.points[v] = edge_point(h, e);
    refined.outgoing[v] = HalfedgeId(TriangleSplit::outgoing_of_edge_vertex(h, view.is_boundary(h)));
  });
  A3D_TRY(monitor.check());
  for_each_element(view.face_count(), stage,
                   [&](std::uint32_t f) { TriangleSplit::write_faces(view, f, edge_vertices.data(), refined); });
  for_each_element(vertex_count, stage, [&](std::uint32_t v) {
    const std::uint32_t h = view.outgoing(v);
    refined.points[v] = h == kNone ? view.point(v) : vertex_point(v);
    refined.outgoing[v] = h == kNone ? HalfedgeId() : HalfedgeId(TriangleSplit::first_half(h));
  });
  return std::move(refined).finish(PolygonLayout::of_degree(3), monitor);
}

/// The provenance of attributes after a step with split_triangles.
Provenance triangle_split_provenance(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given);

}  // namespace algebra3d::subdivision
