#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/face_measures.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

/// Normals of faces, vertices and corners, and angles between faces. A normal has length 1, up to rounding; the zero
/// vector stands for none.
namespace algebra3d {

/// The corners of a face, by the numbers of their points.
template <typename Layout>
std::span<const std::uint32_t> corner_indices(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  return std::span(mesh.origins()).subspan(mesh.halfedge(f).index(), mesh.degree(f));
}

/// Normal and area of a face: see nearest_vector_area. Exactness: each number rounded once.
template <typename Layout>
VectorArea vector_area(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  return nearest_vector_area(mesh.points(), corner_indices(mesh, f));
}

/// The angle between the normals of the two faces of a manifold edge: 0 flat, positive convex, negative concave (seen
/// from the side to which the normals point). Units: degrees, above -180 and at most 180. Nothing at other edges, and
/// if a face has no normal. Exactness: within 1e-12 degrees; 0 for faces in parallel planes that face the same way,
/// also where the true angle is below 1e-13 degrees.
template <typename Layout>
std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge);

/// The normals of all faces. Exactness: within 1e-9, for faces that are not slivers a few ulp. Cost: linear, some
/// nanoseconds per face; as vector_area at corners that are not doubles and for slivers.
template <typename Layout>
std::vector<Vec3> face_normals(const HalfedgeMesh<Layout>& mesh);
/// Writes the normals of all faces to `normals`, one per face.
template <typename Layout>
void face_normals(const HalfedgeMesh<Layout>& mesh, std::span<Vec3> normals);

/// The normal of a vertex: the sum of the normals of its faces (vector_area), weighted by their angles at the vertex.
/// None at an isolated vertex, and where the normals cancel up to 2^-40 of the sum of the angles. Exactness: within
/// 1e-15 times the sum of the angles divided by the length of the sum. Source: [thuermer1998].
template <typename Layout>
Vec3 vertex_normal(const HalfedgeMesh<Layout>& mesh, VertexId v);
/// The normals of all vertices. Exactness: sums of normals as of face_normals and of angles that are within
/// 2^-49 / sin(a), where a is the angle at a triangle's first corner, at most 1e-9 and mostly a few ulp; the same bits
/// on all processors. Cost: linear; some nanoseconds per face with three or four corners, tens for others, and as
/// vector_area for slivers and corners that are not doubles.
template <typename Layout>
std::vector<Vec3> vertex_normals(const HalfedgeMesh<Layout>& mesh);
/// Writes the normals of all vertices to `normals`, one per vertex.
template <typename Layout>
void vertex_normals(const HalfedgeMesh<Layout>& mesh, std::span<Vec3> normals);

/// Normals of corners; corners of a vertex share one unless a crease is between them.
struct CornerNormals {
  std::vector<Vec3> normals;
  std::vector<std::uint32_t> of_corner;  ///< the normal of the corner that each half-edge leaves
};
/// The normals of corners where the corners of each fan are divided at creases: edges at which the angle between the
/// normals of the faces is larger than `crease_angle_degrees`, and all edges that are not manifold. The normal of a
/// part of a fan is that of a vertex with these faces; if its normals cancel, that of its first face. Normals are
/// numbered by vertex, then round the fan. Cost: linear; about that of vertex_normals where there are few creases.
template <typename Layout>
CornerNormals corner_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals,
                             double crease_angle_degrees);

}  // namespace algebra3d
