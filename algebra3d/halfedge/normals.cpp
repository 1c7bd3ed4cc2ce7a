#include "algebra3d/halfedge/normals.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "algebra3d/base/scheduler.h"
#include "algebra3d/exact/plane.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/detail/weighted_normals.h"

namespace algebra3d {
namespace {

// ---- faces

/// A multiple of a normal by doubles, and the size of the products that it is a sum of, squared.
struct RoundedNormal {
  Vec3 sum;
  double squared_products = 0;
};

RoundedNormal rounded_normal(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners) {
  const auto product = [](const Vec3& u, const Vec3& v) { return RoundedNormal{cross(u, v), dot(u, u) * dot(v, v)}; };
  const Vec3 &a = points[corners[0]], &b = points[corners[1]], &c = points[corners[2]];
  if (corners.size() == 3) return product(b - a, c - a);
  if (corners.size() == 4) return product(c - a, points[corners[3]] - b);
  RoundedNormal result;
  double products = 0;
  Vec3 before = b - a;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 next = points[corners[i]] - a;
    result.sum = result.sum + cross(before, next);
    products += 0.5 * (dot(before, before) + dot(next, next));  // no less than the product of the lengths
    before = next;
  }
  result.squared_products = products * products;
  return result;
}

/// The normal by doubles alone; nothing where that is not within 1e-9: relative to the products the error is below
/// 2^-50 per corner.
std::optional<Vec3> quick_normal(const PointArray& points, std::span<const std::uint32_t> corners) {
  constexpr double kLeastShare = 0x1p-20;
  if (points.exact_count() != 0 &&
      !std::ranges::all_of(corners, [&](std::uint32_t corner) { return points[corner].is_double(); }))
    return std::nullopt;
  const RoundedNormal rounded = rounded_normal(points.approx(), corners);
  const double squared = dot(rounded.sum, rounded.sum);
  if (!(squared > kLeastShare * kLeastShare * rounded.squared_products) || !(squared > 0x1p-800) ||
      !(squared < 0x1p800))
    return std::nullopt;
  return 1 / std::sqrt(squared) * rounded.sum;
}

// ---- edges

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
  parallel_for(mesh.face_count(), kFacesPerTask, [&](std::size_t f) {
    const std::optional<Vec3> quick = quick_normal(mesh.points(), corner_indices(mesh, FaceId(f)));
    normals[f] = quick ? *quick : vector_area(mesh, FaceId(f)).normal;
  });
}

template <typename Layout>
std::vector<Vec3> face_normals(const HalfedgeMesh<Layout>& mesh) {
  std::vector<Vec3> normals;
  detail::resize_large(normals, mesh.face_count());
  face_normals(mesh, normals);
  return normals;
}

template <typename Layout>
Vec3 vertex_normal(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  detail::WeightedNormal sum;
  for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
    const Vec3 normal = vector_area(mesh, mesh.face(h)).normal;
    sum.add(normal, detail::corner_angle(mesh, h, normal));
  }
  return sum.direction();
}

template <typename Layout>
void vertex_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals, std::span<Vec3> normals) {
  assert(face_normals.size() == mesh.face_count() && normals.size() == mesh.vertex_count());
  parallel_for(detail::vertex_task_count(mesh.vertex_count()), 1, [&](std::size_t task) {
    const std::size_t begin = task * detail::kVerticesPerTask,
                      end = std::min(mesh.vertex_count(), begin + detail::kVerticesPerTask);
    detail::VertexNormalsMaker<Layout>(mesh, face_normals, normals).make(begin, end, begin);
  });
}

template <typename Layout>
std::vector<Vec3> vertex_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals) {
  std::vector<Vec3> normals(mesh.vertex_count());
  vertex_normals(mesh, face_normals, normals);
  return normals;
}

template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<TriangleLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<TriangleLayout>&);
template void face_normals(const HalfedgeMesh<TriangleLayout>&, std::span<Vec3>);
template Vec3 vertex_normal(const HalfedgeMesh<TriangleLayout>&, VertexId);
template std::vector<Vec3> vertex_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>);
template void vertex_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>, std::span<Vec3>);
template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<PolygonLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<PolygonLayout>&);
template void face_normals(const HalfedgeMesh<PolygonLayout>&, std::span<Vec3>);
template Vec3 vertex_normal(const HalfedgeMesh<PolygonLayout>&, VertexId);
template std::vector<Vec3> vertex_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>);
template void vertex_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>, std::span<Vec3>);

}  // namespace algebra3d
