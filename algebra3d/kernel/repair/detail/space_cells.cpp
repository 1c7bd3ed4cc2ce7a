#include "algebra3d/kernel/repair/detail/space_cells.h"

#include <algorithm>
#include <vector>

#include "algebra3d/kernel/arrangement/upward_rays.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "base/id_vector.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Per connected component: the face whose middle is highest, rounded; the first one of several.
IdVector<ComponentId, FaceId> highest_faces(const TriangleMesh& surface, const FaceComponents& components) {
  IdVector<ComponentId, double> heights(components.count);
  IdVector<ComponentId, FaceId> result(components.count);
  for (const FaceId face : faces(surface)) {
    double height = 0;
    for (const PointRef& corner : surface.corners(face)) height += corner.approx.z / 3;
    const ComponentId component(components.of_face[face.index()]);
    if (result[component].is_valid() && !(height > heights[component])) continue;
    result[component] = face;
    heights[component] = height;
  }
  return result;
}

ExactPoint exact_middle(const TriangleRef& triangle) {
  return ExactPoint(Rational(1, 3) * (triangle[0].rational() + triangle[1].rational() + triangle[2].rational()));
}

}  // namespace

SpaceCells::SpaceCells(const TriangleMesh& surface)
    : surface_(surface),
      outside_(static_cast<std::uint32_t>(2 * surface.face_count())),
      sides_(2 * surface.face_count() + 1) {}

Status SpaceCells::find(const Monitor& monitor) {
  join_across_simple_edges();
  A3D_TRY(join_around_nonmanifold_edges(monitor));
  return join_components(monitor);
}

/// At a boundary edge both sides of its face lie in one cell; at a manifold edge the sides of its two faces that look
/// the same way do.
void SpaceCells::join_across_simple_edges() {
  for (const HalfedgeId h : halfedges(surface_)) {
    const FaceId face = TriangleMesh::face(h);
    if (surface_.is_boundary(h)) sides_.unite(FaceSide::front(face), FaceSide::back(face));
    const HalfedgeId other = surface_.opposite(h);
    if (!other.is_valid()) continue;
    sides_.unite(FaceSide::front(face), FaceSide::front(TriangleMesh::face(other)));
    sides_.unite(FaceSide::back(face), FaceSide::back(TriangleMesh::face(other)));
  }
}

Status SpaceCells::join_around_nonmanifold_edges(const Monitor& monitor) {
  Stage stage(monitor.silent(), {}, surface_.nonmanifold_edge_count());
  for (std::size_t n = 0; n < surface_.nonmanifold_edge_count(); ++n) {
    if (!stage.begin_step()) return Monitor::interrupted();
    join_around(surface_.nonmanifold_edge(n));
  }
  return {};
}

/// From each face around the edge, a cell reaches to the next one.
void SpaceCells::join_around(std::span<const HalfedgeId> edge) {
  const VertexId from = surface_.origin(edge[0]), to = surface_.target(edge[0]);
  std::vector<HalfedgeId> around(edge.begin(), edge.end());
  const auto apex = [&](HalfedgeId h) { return surface_.point(surface_.origin(TriangleMesh::prev(h))); };
  std::ranges::sort(around, [&](HalfedgeId a, HalfedgeId b) {
    return std::is_lt(compare_around_edge(surface_.point(from), surface_.point(to), apex(edge[0]), apex(a), apex(b)));
  });
  for (std::size_t i = 0; i < around.size(); ++i) {
    const HalfedgeId h = around[i], next = around[i + 1 == around.size() ? 0 : i + 1];
    // Turning counter-clockwise, a face that runs forward along the edge is left to its front.
    const bool leaves_to_front = surface_.origin(h) == from, arrives_from_front = surface_.origin(next) != from;
    sides_.unite(FaceSide::of(TriangleMesh::face(h), leaves_to_front),
                 FaceSide::of(TriangleMesh::face(next), arrives_from_front));
  }
}

/// A component lies in the cell that is found going up from its highest face: below a face of another component, or
/// the unbounded one.
Status SpaceCells::join_components(const Monitor& monitor) {
  UpwardRays rays(surface_);
  const FaceComponents components = connected_components(surface_);
  const IdVector<ComponentId, FaceId> highest = highest_faces(surface_, components);
  for (const ComponentId component : highest.ids()) {
    A3D_TRY(monitor.check());
    const TriangleRef start = surface_.corners(highest[component]);
    FaceSide above = FaceSide::of(highest[component], leads_up_to_front(start));
    bool is_outermost = true;
    rays.for_each(exact_middle(start), [&](FaceId face, bool looks_up) {
      is_outermost = ComponentId(components.of_face[face.index()]) == component;
      if (!is_outermost) sides_.unite(above, FaceSide::of(face, !looks_up));
      above = FaceSide::of(face, looks_up);
      return is_outermost;
    });
    if (is_outermost) sides_.unite(above, outside_);
  }
  return {};
}

}  // namespace algebra3d
