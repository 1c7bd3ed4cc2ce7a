#include "algebra3d/kernel/repair/detail/one_sided_patches.h"

#include <limits>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/detail/holes.h"
#include "algebra3d/kernel/repair/detail/nonmanifold_loops.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Per component: whether it has a boundary, and an edge along which its two triangles run in the same direction.
std::vector<bool> cannot_be_oriented(const TriangleMesh& mesh, const FaceComponents& components) {
  std::vector<bool> has_boundary(components.count), has_fold(components.count);
  for (const HalfedgeId h : halfedges(mesh)) {
    const std::size_t c = components.of_face[TriangleMesh::face(h).index()];
    if (mesh.is_boundary(h)) has_boundary[c] = true;
    if (!mesh.is_nonmanifold(h)) continue;
    const auto edge = mesh.edge_halfedges(h);
    if (edge.size() == 2 && mesh.origin(edge[0]) == mesh.origin(edge[1])) has_fold[c] = true;
  }
  std::vector<bool> result;
  for (std::size_t c = 0; c < components.count; ++c) result.push_back(has_boundary[c] && has_fold[c]);
  return result;
}

/// Per triangle of the soup, whose holes are closed for trial: whether that adds more than 3/4 of the area of its
/// component.
Result<IdVector<FaceId, bool>> need_much(IndexedSoup soup, const Monitor& monitor) {
  constexpr double kMostOfArea = 0.75;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const std::size_t own_count = soup.triangles.size();
  RepairReport unused;
  A3D_TRY(close_holes(soup, {kAny, false}, unused, monitor.silent()));
  A3D_TRY(close_nonmanifold_loops(soup, {kAny}, unused, monitor.silent()));
  const FaceComponents components = connected_components(*soup.mesh());
  std::vector<double> own(components.count), added(components.count);
  for (const FaceId face : soup.triangles.ids())
    (face.index() < own_count ? own : added)[components.of_face[face.index()]] += soup.area(face);
  IdVector<FaceId, bool> result;
  for (std::size_t f = 0; f < own_count; ++f) {
    const std::size_t c = components.of_face[f];
    result.push_back(added[c] > kMostOfArea * own[c]);
  }
  return result;
}

}  // namespace

Result<IdVector<FaceId, bool>> one_sided_patches(const IndexedSoup& soup, const Monitor& monitor) {
  const auto mesh = soup.mesh();
  const FaceComponents components = connected_components(*mesh);
  const std::vector<bool> is_suspect = cannot_be_oriented(*mesh, components);
  IdVector<FaceId, bool> result(mesh->face_count()), is_other;
  for (const FaceId face : faces(*mesh)) is_other.push_back(!is_suspect[components.of_face[face.index()]]);
  IndexedSoup suspects = soup;
  suspects.drop(is_other);
  if (suspects.triangles.empty()) return result;
  A3D_ASSIGN(const auto is_open, need_much(std::move(suspects), monitor));
  std::size_t place = 0;
  for (const FaceId face : faces(*mesh))
    if (!is_other[face]) result[face] = is_open[FaceId(place++)];
  return result;
}

}  // namespace algebra3d
