#pragma once

#include <algorithm>
#include <cstddef>
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
  static HalfedgeId first_half(HalfedgeId h) { return HalfedgeId(12 * (h.index() / 3) + 3 * (h.index() % 3)); }
  static HalfedgeId second_half(HalfedgeId h) { return places_on(first_half(TriangleLayout::next(h)), 2); }
  /// The half-edge from the edge vertex of h to the one before it, in the triangle at the origin of h.
  static HalfedgeId cut(HalfedgeId h) { return places_on(first_half(h), 1); }
  /// The half-edge of that edge in the middle triangle, where half-edge 12f + 9 + i leaves the edge vertex of half-edge
  /// i.
  static HalfedgeId middle(HalfedgeId h) { return HalfedgeId(12 * (h.index() / 3) + 9 + h.index() % 3); }

  /// The outgoing half-edge of the vertex on the edge of h, which is the first of the edge.
  static HalfedgeId outgoing_of_edge_vertex(HalfedgeId h, bool is_boundary) {
    if (is_boundary) return second_half(h);
    // The lowest that leaves it; the other triangle of the edge has higher ones.
    return std::min(cut(h), second_half(h));
  }

  /// Writes the four triangles of f. `edge_vertices` has the vertex of each half-edge.
  static void write_faces(const TriangleView& view, FaceId f, const LargeVector<VertexId>& edge_vertices,
                          RefinedMesh& refined) {
    for (const HalfedgeId h : view.halfedges_of(f)) {
      const HalfedgeId before = view.prev(h), start = first_half(h), o = view.opposite(h);
      const VertexId on_edge = edge_vertices[h.index()];
      refined.set_corner(start, view.origin(h));
      refined.set_corner(cut(h), on_edge);
      refined.set_corner(places_on(start, 2), edge_vertices[before.index()]);
      refined.set_corner(middle(h), on_edge);
      // The cut at the corner runs from the edge vertex of h to that before it; in the middle it runs back.
      refined.link(cut(h), middle(before));
      refined.set_opposite(start, o.is_none() ? o : second_half(o));
      refined.set_opposite(second_half(h), o.is_none() ? o : first_half(o));
    }
  }

 private:
  static HalfedgeId places_on(HalfedgeId h, unsigned count) { return HalfedgeId(h.index() + count); }
};

/// The mesh with each triangle divided into four. edge_point(h, e) is the new vertex on edge number e, whose first
/// half-edge is h; vertex_point(v) is the new place of a vertex that is not isolated. Error: interrupted.
template <typename EdgePoint, typename VertexPoint>
Result<PolygonMesh> split_triangles(const StepInput& input, const EdgePoint& edge_point,
                                    const VertexPoint& vertex_point) {
  const Monitor& monitor = input.monitor;
  const TriangleView view(input.mesh);
  const std::size_t vertex_count = view.vertex_count(), halfedge_count = view.halfedge_count();
  const Stage stage(monitor, input.what,
                    2 * block_count(halfedge_count) + block_count(view.face_count()) + block_count(vertex_count));
  const EdgeEnumeration edges(view, Edges::all, stage);
  A3D_TRY(monitor.check());
  RefinedMesh refined(vertex_count + edges.count(), 4 * halfedge_count);
  LargeVector<VertexId> edge_vertices;
  edge_vertices.resize(halfedge_count);
  edges.for_each(stage, [&](HalfedgeId h, EdgeNumber e) {
    const VertexId v(vertex_count + e.index());
    const HalfedgeId o = view.opposite(h);
    edge_vertices[h.index()] = v;
    if (o.is_valid()) edge_vertices[o.index()] = v;
    refined.set_vertex(v, edge_point(h, e), TriangleSplit::outgoing_of_edge_vertex(h, o.is_none()));
  });
  A3D_TRY(monitor.check());
  for_each_element<FaceId>(view.face_count(), stage,
                           [&](FaceId f) { TriangleSplit::write_faces(view, f, edge_vertices, refined); });
  for_each_element<VertexId>(vertex_count, stage, [&](VertexId v) {
    const HalfedgeId h = view.outgoing(v);
    if (h.is_none())
      refined.set_vertex(v, view.point(v), h);
    else
      refined.set_vertex(v, vertex_point(v), TriangleSplit::first_half(h));
  });
  return std::move(refined).finish(PolygonLayout::of_degree(3), monitor);
}

/// The provenance of attributes after a step with split_triangles.
Provenance triangle_split_provenance(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given);

}  // namespace algebra3d::subdivision
