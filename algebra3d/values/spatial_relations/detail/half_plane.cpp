#include "algebra3d/values/spatial_relations/detail/half_plane.h"

#include <array>
#include <span>

namespace algebra3d {
namespace {

/// Calls visit(h) for each half-edge along the edge.
template <typename Visit>
void for_each_along(const TriangleMesh& mesh, HalfedgeId halfedge, const Visit& visit) {
  if (mesh.is_nonmanifold(halfedge)) {
    for (const HalfedgeId h : mesh.edge_halfedges(halfedge)) visit(h);
    return;
  }
  visit(halfedge);
  if (const HalfedgeId h = mesh.opposite(halfedge); h.is_valid()) visit(h);
}

}  // namespace

Placement place_half_plane(const MeshSet& set, HalfedgeId halfedge, PointRef point) {
  const TriangleMesh& mesh = set.mesh();
  const VertexId from = mesh.origin(halfedge);
  const PointRef e0 = mesh.point(from), e1 = mesh.point(mesh.target(halfedge));
  const auto third_corner = [&](HalfedgeId h) { return mesh.point(mesh.origin(TriangleMesh::prev(h))); };
  bool is_on_face = false;
  HalfedgeId next;  // of the first face that the half-plane meets when it turns counter-clockwise
  for_each_along(mesh, halfedge, [&](HalfedgeId h) {
    const PointRef corner = third_corner(h);
    is_on_face = is_on_face || overlap_beyond_shared_edge(e0, e1, point, corner);
    if (!is_on_face && set.is_solid &&
        (!next.is_valid() || std::is_lt(compare_around_edge(e0, e1, point, corner, third_corner(next)))))
      next = h;
  });
  if (is_on_face) return Placement::boundary;
  // A face that runs from e0 to e1 has its back towards those that come before it.
  return set.is_solid && mesh.origin(next) == from ? Placement::inside : Placement::outside;
}

}  // namespace algebra3d
