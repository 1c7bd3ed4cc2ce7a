#include "algebra3d/values/display/levels_of_detail.h"

#include <cassert>
#include <utility>

#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/soup/mesh_triangulation.h"
#include "algebra3d/values/display/detail/level_mesh.h"
#include "algebra3d/values/display/detail/shape_parts.h"
#include "algebra3d/values/display/detail/task_size.h"
#include "algebra3d/values/display/shape_of_value.h"
#include "algebra3d/values/display/vertex_clustering.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// The triangles of a value from which its levels are made.
struct LevelSource {
  DrawnShape whole;  ///< without arrays
  std::vector<IndexTriangle> triangles;
  const PointArray* points = nullptr;
  detail::DefectEdges defects;
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
  return LevelSource{std::move(whole), std::move(triangles), &value.mesh().points(), detail::defects_of(value.mesh())};
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
    source_.defects = detail::drawn_together(source_.defects, level_.point_of);
    return detail::shape_of_level(source_.whole, level_, source_.defects, max_triangles, monitor_);
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
