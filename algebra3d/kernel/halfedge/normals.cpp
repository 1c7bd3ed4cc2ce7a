#include "algebra3d/kernel/halfedge/normals.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/detail/face_normal.h"
#include "algebra3d/kernel/halfedge/detail/weighted_normals.h"
#include "base/large_allocator.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// The sign of the angle at an edge: positive if it is convex. Exact.
template <typename Layout>
int turning_sign(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  const auto exact_normal = [&](FaceId f) { return exact_doubled_vector_area(mesh.points(), corner_indices(mesh, f)); };
  const RationalVec3 along = mesh.point(mesh.target(edge)).rational() - mesh.point(mesh.origin(edge)).rational();
  return dot(cross(exact_normal(mesh.face(edge)), exact_normal(mesh.face(mesh.opposite(edge)))), along).sign();
}

}  // namespace

template <typename Layout>
std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  const HalfedgeId opposite = mesh.opposite(edge);
  if (!opposite.is_valid()) return std::nullopt;
  const VectorArea left = vector_area(mesh, mesh.face(edge)), right = vector_area(mesh, mesh.face(opposite));
  if (!left.has_normal() || !right.has_normal()) return std::nullopt;
  const double angle = detail::angle_between(left.normal, right.normal) * detail::kDegreesPerRadian;
  if (angle == 0) return 0;
  // Where the faces nearly lie upon each other rounding could turn 180 degrees round.
  constexpr double kNearlyFolded = 179.99;
  if (angle > kNearlyFolded) return turning_sign(mesh, edge) < 0 ? -angle : angle;
  const Vec3 along = mesh.point(mesh.target(edge)).approx - mesh.point(mesh.origin(edge)).approx;
  return dot(cross(left.normal, right.normal), along) < 0 ? -angle : angle;
}

template <typename Layout>
void face_normals(const HalfedgeMesh<Layout>& mesh, std::span<Vec3> normals) {
  assert(normals.size() == mesh.face_count());
  constexpr std::size_t kFacesPerTask = 20000;
  parallel_for(mesh.face_count(), kFacesPerTask,
               [&](std::size_t f) { normals[f] = detail::face_normal(mesh, FaceId(f)); });
}

template <typename Layout>
std::vector<Vec3> face_normals(const HalfedgeMesh<Layout>& mesh) {
  std::vector<Vec3> normals;
  resize_large(normals, mesh.face_count());
  face_normals(mesh, normals);
  return normals;
}

template <typename Layout>
Vec3 vertex_normal(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  detail::WeightedSum sum;
  for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
    const Vec3 normal = vector_area(mesh, mesh.face(h)).normal;
    sum.add(normal, detail::corner_angle(mesh, h, normal));
  }
  return sum.direction();
}

template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<TriangleLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<TriangleLayout>&);
template void face_normals(const HalfedgeMesh<TriangleLayout>&, std::span<Vec3>);
template Vec3 vertex_normal(const HalfedgeMesh<TriangleLayout>&, VertexId);
template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<PolygonLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<PolygonLayout>&);
template void face_normals(const HalfedgeMesh<PolygonLayout>&, std::span<Vec3>);
template Vec3 vertex_normal(const HalfedgeMesh<PolygonLayout>&, VertexId);

}  // namespace algebra3d
