#include "algebra3d/mesh/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "algebra3d/kernel/soup/mesh_triangulation.h"
#include "algebra3d/meshes/mesh_access.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/nearest_rounding.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

namespace algebra3d::mesh {
namespace {

using detail::MeshAccess;

/// Whether sums of such weights neither overflow nor lose digits; the weight of isolated vertices is out of range, too.
bool is_in_range(double weight) {
  return weight > 1e-280 && weight < 1e280;
}

/// The direction of a sum of vectors whose lengths have the sum `weight`; zero if they cancel.
Vec3 direction_of_sum(const Vec3& sum, double weight) {
  const double size = length(sum);
  return size > 0x1p-40 * weight ? 1 / size * sum : Vec3{};
}

/// The direction of the sum of the vector areas of the faces at a vertex, which are beyond the range of doubles:
/// computed at another scale.
template <typename Kernel>
Vec3 normal_of_areas(const Kernel& mesh, VertexId v) {
  const std::vector<Vec3>& points = mesh.points().approx();
  double largest = 0;
  for (const FaceId f : faces_around(mesh, v))
    for (const VertexId corner : vertices_of(mesh, f)) {
      const Vec3 side = points[corner.index()] - points[v.index()];
      largest = std::max({largest, std::abs(side.x), std::abs(side.y), std::abs(side.z)});
    }
  if (largest == 0) return {};
  const int exponent = std::ilogb(std::min(largest, std::numeric_limits<double>::max()));
  const auto scaled = [&](const Vec3& p) {
    return Vec3{std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent)};
  };
  const auto side_to = [&](VertexId corner) { return scaled(points[corner.index()]) - scaled(points[v.index()]); };
  Vec3 sum;
  double weight = 0;
  for (const FaceId f : faces_around(mesh, v)) {
    Vec3 area;
    for (const HalfedgeId h : halfedges_of(mesh, f))
      area = area + cross(side_to(mesh.origin(h)), side_to(mesh.target(h)));
    sum = sum + area;
    weight += length(area);
  }
  return direction_of_sum(sum, weight);
}

/// The sums of the normals of faces at vertices, multiplied by weight_of(face).
template <typename Kernel, typename WeightOf>
std::vector<Vec3> normals_of_sums(const Kernel& mesh, const std::vector<Vec3>& face_normals, WeightOf weight_of) {
  std::vector<Vec3> sums(mesh.vertex_count());
  std::vector<double> weights(mesh.vertex_count(), 0);
  for (const FaceId f : faces(mesh)) {
    const double weight = weight_of(f);
    for (const VertexId v : vertices_of(mesh, f)) {
      sums[v.index()] = sums[v.index()] + weight * face_normals[f.index()];
      weights[v.index()] += weight;
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v)
    sums[v] = is_in_range(weights[v]) ? direction_of_sum(sums[v], weights[v]) : normal_of_areas(mesh, VertexId(v));
  return sums;
}

std::vector<CornerTriangle> corner_triangles(const algebra3d::TriangleMesh& mesh) {
  std::vector<CornerTriangle> result;
  result.reserve(mesh.face_count());
  for (const FaceId f : faces(mesh)) result.push_back({mesh.halfedge(f, 0), mesh.halfedge(f, 1), mesh.halfedge(f, 2)});
  return result;
}

Result<std::vector<CornerTriangle>> triangles_to_draw(const algebra3d::TriangleMesh& mesh, const Monitor& /*monitor*/) {
  return corner_triangles(mesh);
}
Result<std::vector<CornerTriangle>> triangles_to_draw(const algebra3d::PolygonMesh& mesh, const Monitor& monitor) {
  return triangulate_faces(mesh, monitor);
}

void append(std::vector<float>& numbers, const Vec3& v) {
  for (const double x : {v.x, v.y, v.z}) numbers.push_back(static_cast<float>(x));
}

Vec3 centre_of(const Box3& box) {
  return box.is_empty() ? Vec3{} : 0.5 * box.min + 0.5 * box.max;
}

template <typename Kernel>
Result<RenderBuffers> buffers_of(const Kernel& mesh, double crease_degrees, const Monitor& monitor) {
  const std::vector<Vec3>& points = mesh.points().approx();
  const CornerNormals corners = corner_normals(mesh, algebra3d::face_normals(mesh), crease_degrees);
  A3D_ASSIGN(const std::vector<CornerTriangle> triangles, triangles_to_draw(mesh, monitor));
  RenderBuffers buffers;
  const Box3 box = Box3::around(points);
  buffers.origin = centre_of(box);
  for (std::size_t axis = 0; axis < 3 && !box.is_empty(); ++axis)
    if (box.max[axis] / 2 - box.min[axis] / 2 > std::numeric_limits<float>::max())
      return Error{ErrorCode::limit_exceeded, "render_buffers: a mesh from {} to {} is beyond the range of floats",
                   box.min[axis], box.max[axis]};
  buffers.vertices.resize(corners.normals.size());
  for (const HalfedgeId h : halfedges(mesh)) buffers.vertices[corners.of_corner[h.index()]] = mesh.origin(h);
  buffers.positions.reserve(3 * corners.normals.size());
  buffers.normals.reserve(3 * corners.normals.size());
  for (std::size_t i = 0; i < corners.normals.size(); ++i) {
    append(buffers.positions, points[buffers.vertices[i].index()] - buffers.origin);
    append(buffers.normals, corners.normals[i]);
  }
  buffers.triangles.reserve(3 * triangles.size());
  buffers.faces.reserve(triangles.size());
  for (const CornerTriangle& triangle : triangles) {
    for (const HalfedgeId h : triangle) buffers.triangles.push_back(corners.of_corner[h.index()]);
    buffers.faces.push_back(mesh.face(triangle[0]));
  }
  return buffers;
}

}  // namespace

template <AnyMesh M>
std::vector<Vec3> face_normals(const M& mesh) {
  const NearestRounding rounding;
  return algebra3d::face_normals(MeshAccess::content(mesh));
}

template <AnyMesh M>
std::vector<Vec3> vertex_normals(const M& mesh, NormalWeight weight) {
  const NearestRounding rounding;
  const auto& content = MeshAccess::content(mesh);
  if (weight == NormalWeight::angle) return algebra3d::vertex_normals(content);
  const std::vector<Vec3> of_faces = algebra3d::face_normals(content);
  if (weight == NormalWeight::uniform) return normals_of_sums(content, of_faces, [](FaceId) { return 1.0; });
  return normals_of_sums(content, of_faces, [&](FaceId f) { return vector_area(content, f).area; });
}

template <AnyMesh M>
std::optional<double> dihedral_angle_degrees(const M& mesh, EdgeId e) {
  const NearestRounding rounding;
  return algebra3d::dihedral_angle_degrees(MeshAccess::content(mesh), mesh.halfedge(e));
}

template <AnyMesh M>
Result<RenderBuffers> render_buffers(const M& mesh, double crease_degrees, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<RenderBuffers> {
    if (!(crease_degrees >= 0 && crease_degrees <= 180))
      return Error{ErrorCode::invalid_value, "render_buffers: expected an angle from 0 to 180 degrees, found {}",
                   crease_degrees};
    const InterruptionScope interruption(monitor.cancel());
    return buffers_of(MeshAccess::content(mesh), crease_degrees, monitor);
  });
}

template std::vector<Vec3> face_normals(const TriangleMesh&);
template std::vector<Vec3> face_normals(const PolygonMesh&);
template std::vector<Vec3> vertex_normals(const TriangleMesh&, NormalWeight);
template std::vector<Vec3> vertex_normals(const PolygonMesh&, NormalWeight);
template std::optional<double> dihedral_angle_degrees(const TriangleMesh&, EdgeId);
template std::optional<double> dihedral_angle_degrees(const PolygonMesh&, EdgeId);
template Result<RenderBuffers> render_buffers(const TriangleMesh&, double, const Monitor&);
template Result<RenderBuffers> render_buffers(const PolygonMesh&, double, const Monitor&);

}  // namespace algebra3d::mesh
