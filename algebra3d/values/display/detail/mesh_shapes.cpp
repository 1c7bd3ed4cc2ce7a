#include "algebra3d/values/display/detail/mesh_shapes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "algebra3d/kernel/soup/mesh_triangulation.h"
#include "algebra3d/values/display/detail/shape_parts.h"
#include "algebra3d/values/display/detail/task_size.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::detail {
namespace {

enum class EdgeRole : std::uint8_t { none, edge, boundary, nonmanifold };

/// True if the two triangles at a manifold edge lie in one plane. Exact.
bool is_flat(const TriangleMesh& mesh, HalfedgeId h, HalfedgeId opposite) {
  const std::uint32_t plane = mesh.planes().number(TriangleMesh::face(h).index());
  if (plane != kNone && plane == mesh.planes().number(TriangleMesh::face(opposite).index())) return true;
  const auto apex = [&](HalfedgeId along) { return mesh.point(mesh.origin(TriangleMesh::prev(along))); };
  return orient3d(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), apex(h), apex(opposite)) == 0;
}
/// The faces of a mesh of polygons are elements by themselves, so their edges are drawn wherever they lie.
bool is_flat(const PolygonMesh& /*mesh*/, HalfedgeId /*h*/, HalfedgeId /*opposite*/) {
  return false;
}

/// Decides which edges are drawn, and as what.
template <typename Mesh>
class EdgeChoice {
 public:
  EdgeChoice(const Mesh& mesh, std::span<const Vec3> face_normals)
      : mesh_(mesh), face_normals_(face_normals), has_all_(mesh.halfedge_count() <= 3 * kMostFacesWithAllEdges) {}

  /// The role of the edge of a half-edge; none for all but the first half-edge of an edge.
  EdgeRole operator()(HalfedgeId h) const {
    if (mesh_.is_boundary(h)) return EdgeRole::boundary;
    if (mesh_.is_nonmanifold(h)) return first_along(mesh_, h) == h ? EdgeRole::nonmanifold : EdgeRole::none;
    const HalfedgeId opposite = mesh_.opposite(h);
    return h < opposite && is_drawn(h, opposite) ? EdgeRole::edge : EdgeRole::none;
  }

 private:
  bool is_drawn(HalfedgeId h, HalfedgeId opposite) const {
    if (has_all_) return !is_flat(mesh_, h, opposite);
    return dot(face_normals_[mesh_.face(h).index()], face_normals_[mesh_.face(opposite).index()]) < crease_cosine_;
  }

  const Mesh& mesh_;
  std::span<const Vec3> face_normals_;
  bool has_all_;
  double crease_cosine_ = std::cos(kCreaseDegrees * std::numbers::pi / 180);
};

struct EdgeLines {
  std::vector<DrawnShape::Line> edges, boundary, nonmanifold;
};

template <typename Mesh>
EdgeLines edge_lines(const Mesh& mesh, const EdgeChoice<Mesh>& role_of,
                     const std::vector<std::uint32_t>& position_of_corner, std::size_t begin, std::size_t end) {
  EdgeLines lines;
  for (std::size_t i = begin; i < end; ++i) {
    const HalfedgeId h(i);
    const EdgeRole role = role_of(h);
    if (role == EdgeRole::none) continue;
    std::vector<DrawnShape::Line>& found = role == EdgeRole::edge       ? lines.edges
                                           : role == EdgeRole::boundary ? lines.boundary
                                                                        : lines.nonmanifold;
    found.push_back({position_of_corner[h.index()], position_of_corner[mesh.next(h).index()]});
  }
  return lines;
}

LargeVector<DrawnShape::Line> joined(const std::vector<EdgeLines>& parts,
                                     std::vector<DrawnShape::Line> EdgeLines::*role) {
  std::vector<std::size_t> begins(parts.size() + 1);
  for (std::size_t i = 0; i < parts.size(); ++i) begins[i + 1] = begins[i] + (parts[i].*role).size();
  LargeVector<DrawnShape::Line> all(begins.back());
  parallel_for(parts.size(), 1, [&](std::size_t i) {
    std::ranges::copy(parts[i].*role, all.begin() + static_cast<std::ptrdiff_t>(begins[i]));
  });
  return all;
}

template <typename Mesh>
void add_edges(const Mesh& mesh, const std::vector<std::uint32_t>& position_of_corner,
               std::span<const Vec3> face_normals, DrawnShape& shape) {
  const EdgeChoice<Mesh> role_of(mesh, face_normals);
  std::vector<EdgeLines> parts((mesh.halfedge_count() + kElementsPerTask - 1) / kElementsPerTask);
  parallel_for(parts.size(), 1, [&](std::size_t i) {
    parts[i] = edge_lines(mesh, role_of, position_of_corner, i * kElementsPerTask,
                          std::min((i + 1) * kElementsPerTask, mesh.halfedge_count()));
  });
  shape.edges = joined(parts, &EdgeLines::edges);
  shape.boundary = joined(parts, &EdgeLines::boundary);
  shape.nonmanifold = joined(parts, &EdgeLines::nonmanifold);
}

/// A position for each normal of a corner; `vertex_ids` holds the vertices, also where they are the positions.
template <typename Mesh>
void add_positions(const Mesh& mesh, const CornerNormals& normals, DrawnShape& shape) {
  shape.vertex_ids.resize(normals.normals.size());
  parallel_for(mesh.halfedge_count(), kElementsPerTask, [&](std::size_t h) {
    // Corners that share a position write the same number.
    std::atomic_ref(shape.vertex_ids[normals.of_corner[h]]).store(mesh.origins()[h], std::memory_order_relaxed);
  });
  shape.positions.resize(normals.normals.size());
  shape.normals.resize(normals.normals.size());
  parallel_for(normals.normals.size(), kElementsPerTask, [&](std::size_t i) {
    shape.positions[i] = position_in(shape, mesh.points().approx()[shape.vertex_ids[i]]);
    shape.normals[i] = packed_normal(normals.normals[i]);
  });
}

/// Vertices without faces, as points.
template <typename Mesh>
void add_isolated_vertices(const Mesh& mesh, DrawnShape& shape) {
  for (const VertexId v : vertices(mesh)) {
    poll_interruption_at(v.index());
    if (!mesh.is_isolated(v)) continue;
    shape.points.push_back(add_position(shape, mesh.points().approx()[v.index()]));
    shape.vertex_ids.push_back(v.index());
  }
  if (!shape.normals.empty()) shape.normals.resize(shape.positions.size(), DrawnShape::Normal{0, 0, 127, 0});
}

void drop_if_ascending(LargeVector<std::uint32_t>& ids) {
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (ids[i] != i) return;
  LargeVector<std::uint32_t>().swap(ids);
}

/// Everything but the triangles, whose corners have the positions that are returned.
template <typename Mesh>
Result<std::vector<std::uint32_t>> add_elements(const Mesh& mesh, DrawnShape& shape, const Monitor& monitor) {
  monitor.tell("drawing");
  const std::vector<Vec3> normals_of_faces = face_normals(mesh);
  CornerNormals normals = corner_normals(mesh, normals_of_faces, kCreaseDegrees);
  A3D_TRY(monitor.check());
  add_positions(mesh, normals, shape);
  A3D_TRY(monitor.check());
  add_edges(mesh, normals.of_corner, normals_of_faces, shape);
  add_isolated_vertices(mesh, shape);
  drop_if_ascending(shape.vertex_ids);
  A3D_TRY(monitor.check());
  return std::move(normals.of_corner);
}

}  // namespace

Result<DrawnShape> shape_of_mesh(const TriangleMesh& mesh, const Box3& box, const Monitor& monitor) {
  A3D_ASSIGN(DrawnShape shape, shape_in(box));
  A3D_ASSIGN(const std::vector<std::uint32_t> of_corner, add_elements(mesh, shape, monitor));
  shape.triangle_count = mesh.face_count();
  shape.triangles.resize(mesh.face_count());
  parallel_for(mesh.face_count(), kElementsPerTask, [&](std::size_t f) {
    shape.triangles[f] = {of_corner[3 * f], of_corner[3 * f + 1], of_corner[3 * f + 2]};
  });
  return shape;
}

Result<DrawnShape> shape_of_mesh(const PolygonMesh& mesh, const Box3& box, const Monitor& monitor) {
  A3D_ASSIGN(DrawnShape shape, shape_in(box));
  A3D_ASSIGN(const std::vector<CornerTriangle> triangles, triangulate_faces(mesh, monitor));
  A3D_ASSIGN(const std::vector<std::uint32_t> of_corner, add_elements(mesh, shape, monitor));
  shape.triangle_count = triangles.size();
  shape.triangles.resize(triangles.size());
  shape.face_ids.resize(triangles.size());
  parallel_for(triangles.size(), kElementsPerTask, [&](std::size_t i) {
    const auto& [a, b, c] = triangles[i];
    shape.triangles[i] = {of_corner[a.index()], of_corner[b.index()], of_corner[c.index()]};
    shape.face_ids[i] = mesh.face(a).index();
  });
  drop_if_ascending(shape.face_ids);
  return shape;
}

}  // namespace algebra3d::detail
