#include "algebra3d/values/display/detail/level_mesh.h"

#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/edge_numbers.h"
#include "algebra3d/values/display/detail/cell_numbers.h"
#include "algebra3d/values/display/detail/mesh_shapes.h"
#include "algebra3d/values/display/detail/shape_parts.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d::detail {
namespace {

LargeVector<DrawnShape::Line> drawn_together(const LargeVector<DrawnShape::Line>& edges,
                                             const std::vector<std::uint32_t>& point_of) {
  KeyNumbers numbers(edges.size() / 4);
  LargeVector<DrawnShape::Line> kept;
  for (const auto& [from, to] : edges) {
    const auto [a, b] = std::minmax(point_of[from], point_of[to]);
    if (b == kNone || a == b) continue;
    if (numbers(std::uint64_t{a} << 32U | b) == kept.size()) kept.push_back({a, b});
  }
  return kept;
}

/// The first position of each vertex of the mesh that a shape was made of; kNone if it has none.
std::vector<std::uint32_t> positions_of_vertices(const DrawnShape& shape, std::size_t vertex_count) {
  std::vector<std::uint32_t> positions(vertex_count, kNone);
  for (std::size_t i = shape.positions.size(); i-- > 0;)
    positions[shape.vertex_ids.empty() ? i : shape.vertex_ids[i]] = static_cast<std::uint32_t>(i);
  return positions;
}

/// Lines between vertices as lines between positions, where both have one.
LargeVector<DrawnShape::Line> between(const std::vector<std::uint32_t>& positions,
                                      const LargeVector<DrawnShape::Line>& lines) {
  LargeVector<DrawnShape::Line> found;
  for (const auto& [from, to] : lines)
    if (positions[from] != kNone && positions[to] != kNone) found.push_back({positions[from], positions[to]});
  return found;
}

/// Keeps the first of the vertices without triangles, which are the last positions.
void limit_points(DrawnShape& shape, std::size_t max_points) {
  if (shape.points.size() <= max_points) return;
  shape.positions.resize(shape.positions.size() - (shape.points.size() - max_points));
  shape.normals.resize(shape.normals.empty() ? 0 : shape.positions.size());
  shape.points.resize(max_points);
}

void append(LargeVector<DrawnShape::Line>& lines, const LargeVector<DrawnShape::Line>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

template <typename Layout>
DefectEdges defects_of(const HalfedgeMesh<Layout>& mesh) {
  DefectEdges edges;
  for (const HalfedgeId h : halfedges(mesh)) {
    poll_interruption_at(h.index());
    if (mesh.opposite(h).is_valid() || first_along(mesh, h) != h) continue;
    (mesh.is_boundary(h) ? edges.boundary : edges.nonmanifold)
        .push_back({mesh.origin(h).index(), mesh.target(h).index()});
  }
  return edges;
}

template DefectEdges defects_of(const HalfedgeMesh<TriangleLayout>&);
template DefectEdges defects_of(const HalfedgeMesh<PolygonLayout>&);

DefectEdges drawn_together(const DefectEdges& edges, const std::vector<std::uint32_t>& point_of) {
  return {drawn_together(edges.boundary, point_of), drawn_together(edges.nonmanifold, point_of)};
}

Result<DrawnShape> shape_of_level(const DrawnShape& whole, const ClusteredTriangles& level, const DefectEdges& defects,
                                  std::size_t max_points, const Monitor& monitor) {
  // Points relative to the origin: a box around it gives the origin 0, and so the same positions.
  const Box3 box{whole.box.min - whole.origin, whole.box.max - whole.origin};
  const TriangleMesh mesh(PointArray(level.points), level.triangles);
  A3D_ASSIGN(DrawnShape shape, shape_of_mesh(mesh, box, monitor));
  limit_points(shape, max_points);
  const std::vector<std::uint32_t> positions = positions_of_vertices(shape, level.points.size());
  append(shape.edges, shape.boundary);
  append(shape.edges, shape.nonmanifold);
  shape.boundary = between(positions, defects.boundary);
  shape.nonmanifold = between(positions, defects.nonmanifold);
  LargeVector<std::uint32_t>().swap(shape.vertex_ids);
  shape.kind = whole.kind;
  shape.box = whole.box;
  shape.origin = whole.origin;
  shape.triangle_count = whole.triangle_count;
  shape.deviation = level.deviation();
  return shape;
}

}  // namespace algebra3d::detail
