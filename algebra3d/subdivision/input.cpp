#include "algebra3d/subdivision/detail/input.h"

#include <algorithm>
#include <cmath>

#include "algebra3d/halfedge/circulators.h"

namespace algebra3d::subdivision {
namespace {

/// Sums over two milliards of neighbours with such coordinates are finite.
constexpr double kLargestCoordinate = 0x1p960;

Status check_manifold(const PolygonMesh& mesh) {
  if (mesh.nonmanifold_edge_count() > 0) {
    const auto along = mesh.nonmanifold_edge(0);
    const HalfedgeId h = along.front();
    return Error{ErrorCode::invalid_value,
                 "the edge between vertices {} and {} is non-manifold: {} half-edges run along it, expected two in "
                 "opposite directions, or one at the boundary",
                 mesh.origin(h).index(), mesh.target(h).index(), along.size()};
  }
  const auto vertices = mesh.nonmanifold_vertices();
  if (vertices.empty()) return {};
  return Error{
      ErrorCode::invalid_value,
      "vertex {} is non-manifold: its faces form {} fans, expected one; components divides solids and surfaces "
      "that touch in vertices",
      vertices.front().index(), mesh.fans(vertices.front()).size()};
}

Status check_triangles(const PolygonMesh& mesh, SubdivisionScheme scheme) {
  if (mesh.is_empty() || mesh.common_degree() == 3) return {};
  for (const FaceId f : faces(mesh))
    if (mesh.degree(f) != 3)
      return Error{ErrorCode::invalid_value, "face {} has {} corners, but {} takes triangles only; see triangulate",
                   f.index(), mesh.degree(f), name_of(scheme)};
  return {};
}

/// With two edges at an interior vertex, two edges of the result would join the same vertices: those that cut off its
/// two triangles, or for Doo-Sabin the sides of a face with two corners.
Status check_valences(const PolygonMesh& mesh, SubdivisionScheme scheme) {
  for (const VertexId v : vertices(mesh)) {
    if (mesh.is_isolated(v) || mesh.is_boundary(mesh.outgoing(v))) continue;
    const auto valence = std::ranges::distance(outgoing_halfedges(mesh, v));
    if (valence < 3)
      return Error{ErrorCode::invalid_value, "vertex {} has {} edges and is on no boundary, but {} needs three edges",
                   v.index(), valence, name_of(scheme)};
  }
  return {};
}

/// Where a face meets itself in an edge, two edges of the result would join the middles of both.
Status check_sides(const PolygonMesh& mesh) {
  for (const HalfedgeId h : halfedges(mesh)) {
    if (mesh.is_boundary(h) || mesh.face(mesh.opposite(h)) != mesh.face(h)) continue;
    return Error{ErrorCode::invalid_value,
                 "face {} is on both sides of the edge between vertices {} and {}; see triangulate",
                 mesh.face(h).index(), mesh.origin(h).index(), mesh.target(h).index()};
  }
  return {};
}

Status check_coordinates(const PolygonMesh& mesh) {
  for (const VertexId v : vertices(mesh)) {
    const Vec3& p = mesh.point(v).approx;
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kLargestCoordinate)
      return Error{ErrorCode::limit_exceeded, "vertex {} has a coordinate beyond 2^960", v.index()};
  }
  return {};
}

/// Each step makes four half-edges of one; Doo-Sabin makes less where there is a boundary.
Status check_size(const PolygonMesh& mesh, std::size_t steps) {
  std::size_t halfedges = mesh.halfedge_count();
  for (std::size_t i = 0; i < steps && halfedges > 0; ++i) {
    halfedges *= 4;
    if (halfedges > PolygonMesh::kMaxHalfedges)
      return Error{ErrorCode::limit_exceeded,
                   "{} steps make more than {} half-edges of {}, each step four times as many; at most {} steps are "
                   "possible",
                   steps,
                   PolygonMesh::kMaxHalfedges,
                   mesh.halfedge_count(),
                   i};
  }
  return {};
}

}  // namespace

Status check_input(const PolygonMesh& mesh, SubdivisionScheme scheme, std::size_t steps) {
  if (takes_triangles_only(scheme)) ALGEBRA3D_RETURN_IF_ERROR(check_triangles(mesh, scheme));
  ALGEBRA3D_RETURN_IF_ERROR(check_manifold(mesh));
  ALGEBRA3D_RETURN_IF_ERROR(scheme == SubdivisionScheme::catmull_clark ? check_sides(mesh)
                                                                       : check_valences(mesh, scheme));
  ALGEBRA3D_RETURN_IF_ERROR(check_coordinates(mesh));
  return check_size(mesh, steps);
}

}  // namespace algebra3d::subdivision
