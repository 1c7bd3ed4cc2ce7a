#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/mesh/mesh.h"

/// Normals have length 1, up to rounding; the zero vector stands for none.
namespace algebra3d::mesh {

/// The normals of all faces; that of a bent face is the direction of its vector area. Exactness: within 1e-9, for faces
/// that are not slivers a few ulp. Cost: linear, some nanoseconds per face.
template <AnyMesh M>
std::vector<Vec3> face_normals(const M& mesh);

/// The weights of the normals of faces in the sum at a vertex.
enum class NormalWeight : std::uint8_t {
  angle,   ///< the angle of the face at the vertex: independent of how faces are divided. Source: [thuermer1998]
  area,    ///< the area of the face
  uniform  ///< 1
};

/// The normals of all vertices, the directions of weighted sums of the normals of their faces. None at isolated
/// vertices, and where the normals cancel up to 2^-40. Exactness: sums in doubles, a few ulp but for slivers. Cost:
/// linear; some nanoseconds per face by angles, tens by areas.
template <AnyMesh M>
std::vector<Vec3> vertex_normals(const M& mesh, NormalWeight weight = NormalWeight::angle);

/// The angle between the normals of the two faces of a manifold edge, in degrees: 0 flat, positive convex, negative
/// concave, above -180 and at most 180. Nothing at other edges, and if a face has no normal. Exactness: within 1e-12.
template <AnyMesh M>
std::optional<double> dihedral_angle_degrees(const M& mesh, EdgeId e);

/// Arrays for a graphics card: points with normals, three floats each, and triangles over them. A vertex of the mesh
/// becomes a point for each of its parts between creases.
struct RenderBuffers {
  Vec3 origin;  ///< positions are relative to it: the centre of the box of the mesh
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<std::uint32_t> triangles;  ///< three points each, counter-clockwise
  std::vector<VertexId> vertices;        ///< per point
  std::vector<FaceId> faces;             ///< per triangle
};
/// Edges with a larger angle between the normals of their faces are creases, and so are all that are not manifold; 180:
/// only these. Isolated vertices are left out; polygons are triangulated. Exactness: floats, nearest to the doubles.
/// Errors: invalid_value for an angle that is not between 0 and 180; limit_exceeded for a mesh that is larger than
/// floats can be; interrupted. Cost: linear.
template <AnyMesh M>
Result<RenderBuffers> render_buffers(const M& mesh, double crease_degrees = 30, const Monitor& monitor = {});

}  // namespace algebra3d::mesh
