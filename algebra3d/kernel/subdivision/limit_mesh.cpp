#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/subdivision/detail/input.h"
#include "algebra3d/kernel/subdivision/detail/loop_rules.h"
#include "algebra3d/kernel/subdivision/detail/steps.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using subdivision::MeshView;

/// The point of a uniform cubic B-spline curve at a control point, with the sum of the two beside it.
Vec3 curve_limit(const Vec3& point, const Vec3& neighbours) {
  const Vec3 sum = 4 * point + neighbours;
  return {sum.x / 6, sum.y / 6, sum.z / 6};
}

/// By the left eigenvector of the step: with weight w for each of n neighbours in the step, (a v + sum) / (a + n) with
/// a = 3 / (8 w).
Vec3 loop_limit(const MeshView<3>& view, std::uint32_t v, const subdivision::LoopWeightTable& table) {
  if (view.is_boundary_vertex(v)) return curve_limit(view.point(v), boundary_neighbours_of(view, v));
  const auto neighbours = neighbours_of(view, v);
  const double own = 3 / (8 * table(neighbours.count)), all = own + static_cast<double>(neighbours.count);
  const Vec3 sum = own * view.point(v) + neighbours.sum;
  return {sum.x / all, sum.y / all, sum.z / all};
}

/// In a mesh of quadrilaterals: (n^2 v + 4 e + f) / (n (n + 5)), with e the sum of the neighbours along edges, f that
/// of the corners opposite in the faces.
Vec3 catmull_clark_limit(const MeshView<4>& view, std::uint32_t v) {
  if (view.is_boundary_vertex(v)) return curve_limit(view.point(v), boundary_neighbours_of(view, v));
  Vec3 sum;
  double n = 0;
  view.for_each_outgoing(view.outgoing(v), [&](std::uint32_t h) {
    const std::uint32_t next = view.next(h);
    sum = sum + (4 * view.origin_point(next) + view.target_point(next));
    n += 1;
  });
  const Vec3 all = (n * n) * view.point(v) + sum;
  const double scale = n * (n + 5);
  return {all.x / scale, all.y / scale, all.z / scale};
}

/// The mesh with its vertices moved to `limit(v)`, except isolated ones.
template <typename Limit>
Result<PolygonMesh> moved_vertices(const PolygonMesh& mesh, const Monitor& monitor, const Limit& limit) {
  using subdivision::block_count;
  using subdivision::for_each_element;
  const MeshView<0> view(mesh);
  const Stage stage(monitor, "finding limits", block_count(mesh.vertex_count()) + block_count(mesh.halfedge_count()));
  subdivision::RefinedMesh moved(mesh.vertex_count(), 0);
  moved.corners = mesh.origins();
  moved.opposites.resize(mesh.halfedge_count());
  for_each_element(mesh.halfedge_count(), stage, [&](std::uint32_t h) { moved.opposites[h] = view.opposite(h); });
  for_each_element(mesh.vertex_count(), stage, [&](std::uint32_t v) {
    moved.outgoing[v] = mesh.outgoing(VertexId(v));
    moved.points[v] = moved.outgoing[v].is_valid() ? limit(v) : view.point(v);
  });
  return std::move(moved).finish(mesh.layout(), monitor);
}

}  // namespace

Result<PolygonMesh> limit_mesh(const PolygonMesh& mesh, SubdivisionScheme scheme, const SubdivisionOptions& options,
                               const Monitor& monitor) {
  assert(scheme == SubdivisionScheme::loop || scheme == SubdivisionScheme::catmull_clark);
  A3D_TRY(subdivision::check_input(mesh, scheme, 1));
  if (scheme == SubdivisionScheme::loop) {
    const MeshView<3> view(mesh);
    const subdivision::LoopWeightTable table(options.loop_weights);
    return moved_vertices(mesh, monitor, [&](std::uint32_t v) { return loop_limit(view, v, table); });
  }
  // After a step all faces are quadrilaterals, and vertices have the limits and the numbers that they had before.
  A3D_ASSIGN(const PolygonMesh refined, subdivision::catmull_clark_step(mesh, monitor, "subdividing for limits"));
  const MeshView<4> view(refined);
  return moved_vertices(mesh, monitor, [&](std::uint32_t v) { return catmull_clark_limit(view, v); });
}

}  // namespace algebra3d
