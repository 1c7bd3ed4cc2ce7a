#include "algebra3d/kernel/repair/detail/lost_parts.h"

#include <algorithm>
#include <vector>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/detail/manifold_patches.h"
#include "base/disjoint_ids.h"
#include "base/indices.h"

namespace algebra3d {
namespace {

/// The corners of a solid that are doubles.
PointTable corners_of(const TriangleMesh& solid) {
  PointTable table(solid.points().size());
  for (std::size_t i = 0; i < solid.points().size(); ++i)
    if (const PointRef point = solid.points()[i]; point.is_double()) table.intern(point);
  return table;
}

/// Per face that names its set: whether the solid has a corner of a face of the set.
IdVector<FaceId, bool> sets_that_are_left(const TriangleMesh& given, const TriangleMesh& solid,
                                          DisjointIds<FaceId>& sets) {
  const PointTable corners = corners_of(solid);
  const auto is_left_at = [&](const PointRef& corner) { return corners.find(corner.approx) != kNone; };
  IdVector<FaceId, bool> is_left(given.face_count());
  for (const FaceId face : faces(given))
    if (const FaceId set = sets.find(face); !is_left[set])
      is_left[set] = std::ranges::any_of(given.corners(face), is_left_at);
  return is_left;
}

/// Per face that names its patch: whether the patch has an edge that is not of two faces.
IdVector<FaceId, bool> open_patches(const TriangleMesh& mesh, DisjointIds<FaceId>& patches) {
  IdVector<FaceId, bool> is_open(mesh.face_count());
  for (const HalfedgeId h : halfedges(mesh)) {
    const bool ends_patch = mesh.is_boundary(h) || (mesh.is_nonmanifold(h) && mesh.edge_halfedges(h).size() > 2);
    if (ends_patch) is_open[patches.find(TriangleMesh::face(h))] = true;
  }
  return is_open;
}

/// The connected components of the faces as sets, each named by its first face.
DisjointIds<FaceId> component_sets(const FaceComponents& components) {
  DisjointIds<FaceId> sets(components.of_face.size());
  std::vector<FaceId> first(components.count);
  for (std::size_t f = 0; f < components.of_face.size(); ++f) {
    FaceId& known = first[components.of_face[f]];
    if (!known.is_valid()) known = FaceId(f);
    sets.unite(known, FaceId(f));
  }
  return sets;
}

}  // namespace

LostPatches report_lost_patches(const TriangleMesh& given, const TriangleMesh& solid, RepairReport& report) {
  DisjointIds<FaceId> patches = manifold_patches(given);
  const IdVector<FaceId, bool> is_left = sets_that_are_left(given, solid, patches);
  const IdVector<FaceId, bool> is_open = open_patches(given, patches);
  LostPatches result;
  IdVector<FaceId, bool> is_lost_shell(given.face_count());
  for (const FaceId face : faces(given)) {
    if (patches.find(face) != face || is_left[face]) continue;
    result.is_any = true;
    // Open ones are interfaces, for which the area says more.
    if (is_open[face]) continue;
    report.add(RepairStep::inner_shells, given.corners(face)[0].approx);
    is_lost_shell[face] = true;
  }
  for (const FaceId face : faces(given)) result.is_in_closed_one.push_back(is_lost_shell[patches.find(face)]);
  return result;
}

void report_united_bodies(const TriangleMesh& given, const TriangleMesh& solid, const Vec3& where,
                          RepairReport& report) {
  const FaceComponents components = connected_components(given);
  std::vector<bool> is_open(components.count);
  for (const HalfedgeId h : halfedges(given))
    if (given.is_boundary(h)) is_open[components.of_face[TriangleMesh::face(h).index()]] = true;
  DisjointIds<FaceId> sets = component_sets(components);
  const IdVector<FaceId, bool> is_left = sets_that_are_left(given, solid, sets);
  std::size_t bodies = 0;
  for (const FaceId face : faces(given))
    if (sets.find(face) == face && is_left[face] && !is_open[components.of_face[face.index()]]) ++bodies;
  const std::size_t rest = connected_components(solid).count;
  if (bodies > rest) report.add(RepairStep::united_bodies, where, 0, bodies - rest);
}

}  // namespace algebra3d
