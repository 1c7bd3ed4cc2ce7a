#include "algebra3d/values/display/levels_of_detail.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/soup/mesh_triangulation.h"
#include "algebra3d/values/display/detail/cell_numbers.h"
#include "algebra3d/values/display/detail/mesh_shapes.h"
#include "algebra3d/values/display/detail/shape_parts.h"
#include "algebra3d/values/display/detail/task_size.h"
#include "algebra3d/values/display/shape_of_value.h"
#include "algebra3d/values/display/vertex_clustering.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// The defects of a mesh as pairs of vertices, each edge once.
struct DefectEdges {
  LargeVector<DrawnShape::Line> boundary, nonmanifold;
};

/// The edges after vertices were drawn together: each joins the new places of its ends.
DefectEdges drawn_together(const DefectEdges& edges, const std::vector<std::uint32_t>& point_of);

LargeVector<DrawnShape::Line> drawn_together(const LargeVector<DrawnShape::Line>& edges,
                                             const std::vector<std::uint32_t>& point_of) {
  detail::KeyNumbers numbers(edges.size() / 4);
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

/// The shape of a level. `whole` has no arrays: it gives kind, box, origin and number of triangles of the value, and
/// points of the level are relative to its origin. Points without a triangle are drawn, up to `max_points`. Errors:
/// interrupted.
Result<DrawnShape> shape_of_level(const DrawnShape& whole, const ClusteredTriangles& level, const DefectEdges& defects,
                                  std::size_t max_points, const Monitor& monitor) {
  // Points relative to the origin: a box around it gives the origin 0, and so the same positions.
  const Box3 box{whole.box.min - whole.origin, whole.box.max - whole.origin};
  const TriangleMesh mesh(PointArray(level.points), level.triangles);
  A3D_ASSIGN(DrawnShape shape, detail::shape_of_mesh(mesh, box, monitor));
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

/// The triangles of a value from which its levels are made.
struct LevelSource {
  DrawnShape whole;  ///< without arrays
  std::vector<IndexTriangle> triangles;
  const PointArray* points = nullptr;
  DefectEdges defects;
};

Result<std::vector<IndexTriangle>> triangles_in(const TriangleMesh& mesh, const Monitor& /*monitor*/) {
  return triangles_of(mesh);
}

Result<std::vector<IndexTriangle>> triangles_in(const PolygonMesh& mesh, const Monitor& monitor) {
  A3D_ASSIGN(const std::vector<CornerTriangle> corners, triangulate_faces(mesh, monitor));
  std::vector<IndexTriangle> triangles;
  triangles.reserve(corners.size());
  for (const auto& [a, b, c] : corners)
    triangles.push_back({mesh.origin(a).index(), mesh.origin(b).index(), mesh.origin(c).index()});
  return triangles;
}

template <typename T>
Result<LevelSource> source_of(const T& value, const Monitor& monitor) {
  A3D_ASSIGN(DrawnShape whole, detail::shape_in(value.box()));
  whole.kind = TypeOf<T>::type().name();
  A3D_ASSIGN(std::vector<IndexTriangle> triangles, triangles_in(value.mesh(), monitor));
  whole.triangle_count = triangles.size();
  return LevelSource{std::move(whole), std::move(triangles), &value.mesh().points(), defects_of(value.mesh())};
}

Result<LevelSource> source_of(const Value& value, const Monitor& monitor) {
  if (&value.type() == &TypeOf<Surface3d>::type()) return source_of(value.get<Surface3d>(), monitor);
  if (&value.type() == &TypeOf<Volume3d>::type()) return source_of(value.get<Volume3d>(), monitor);
  return source_of(value.get<Mesh3d>(), monitor);
}

std::vector<Vec3> points_relative_to(const Vec3& origin, const PointArray& points) {
  std::vector<Vec3> relative(points.size());
  parallel_for(points.size(), detail::kElementsPerTask,
               [&](std::size_t i) { relative[i] = points.approx()[i] - origin; });
  return relative;
}

/// Levels, each from the one before.
class LevelMaker {
 public:
  LevelMaker(LevelSource source, const Monitor& monitor)
      : source_(std::move(source)),
        points_(points_relative_to(source_.whole.origin, *source_.points)),
        monitor_(monitor) {}

  Result<DrawnShape> next(std::size_t max_triangles) {
    const TrianglesView fine = is_first_ ? TrianglesView{points_, source_.triangles} : level_.view();
    A3D_ASSIGN(level_, clustered(fine, max_triangles, monitor_));
    is_first_ = false;
    source_.defects = drawn_together(source_.defects, level_.point_of);
    return shape_of_level(source_.whole, level_, source_.defects, max_triangles, monitor_);
  }

 private:
  LevelSource source_;
  std::vector<Vec3> points_;
  const Monitor& monitor_;
  bool is_first_ = true;
  ClusteredTriangles level_;
};

/// Reports how much of the work is done before a step of it, in percent of the time that ten million triangles take.
class Progress {
 public:
  explicit Progress(const Monitor& monitor) : monitor_(monitor) {}

  void before_reading() const { tell(0); }
  void before_drawing_whole() const { tell(30); }
  /// The first level is made of all triangles, the others of few.
  void before_level(std::size_t number) const { tell(number == 0 ? 50 : std::min<std::size_t>(80 + 10 * number, 98)); }

 private:
  void tell(std::size_t percent) const { monitor_.tell("levels of detail, " + std::to_string(percent) + " %"); }

  const Monitor& monitor_;
};

}  // namespace

bool has_levels(const Type& type) {
  return &type == &TypeOf<Surface3d>::type() || &type == &TypeOf<Volume3d>::type() || &type == &TypeOf<Mesh3d>::type();
}

Result<std::vector<DrawnShape>> levels_of_detail(const Value& value, std::span<const std::size_t> max_triangles,
                                                 const Monitor& monitor) {
  assert(has_levels(value.type()));
  std::vector<DrawnShape> levels;
  if (!value.is_defined()) {
    A3D_ASSIGN(const DrawnShape empty, shape_of(value));
    levels.assign(max_triangles.size(), empty);
    return levels;
  }
  const Progress progress(monitor);
  progress.before_reading();
  A3D_ASSIGN(const Value loaded, value.loaded());
  progress.before_drawing_whole();
  const Monitor silent = monitor.silent();
  A3D_ASSIGN(LevelSource source, source_of(loaded, silent));
  const std::uint64_t count = source.whole.triangle_count;
  LevelMaker maker(std::move(source), silent);
  for (const std::size_t most : max_triangles) {
    progress.before_level(levels.size());
    A3D_ASSIGN(DrawnShape level, count <= most ? shape_of(loaded, silent) : maker.next(most));
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace algebra3d
