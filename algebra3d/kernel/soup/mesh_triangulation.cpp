#include "algebra3d/kernel/soup/mesh_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/planar/sweep_triangulation.h"
#include "algebra3d/kernel/soup/loop_triangulation.h"
#include "base/indices.h"

namespace algebra3d {
namespace {

/// A way to look at a face: along an axis, and from the side where it turns counter-clockwise.
struct View {
  Projection projection;
  bool is_flipped;
};

/// One face after the other; `triangles` receives the result.
class FaceTriangulator {
 public:
  explicit FaceTriangulator(const PolygonMesh& mesh) : mesh_(mesh) {}

  void triangulate(FaceId face, std::vector<CornerTriangle>& triangles) {
    collect_corners(face);
    if (corners_.size() < 3) return;
    const std::size_t first = triangles.size();
    for (const IndexTriangle& t : corners_.size() == 3 ? fan() : triangles_of_corners())
      triangles.push_back({corners_[t[0]], corners_[t[1]], corners_[t[2]]});
    // Each face has its triangles in one order, whichever method made them.
    std::ranges::sort(triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.end());
  }

 private:
  PointRef point(std::size_t corner) const { return mesh_.point(mesh_.origin(corners_[corner])); }
  Vec3 approx(std::size_t corner) const { return point(corner).approx; }

  void collect_corners(FaceId face) {
    corners_.clear();
    for (const HalfedgeId h : halfedges_of(mesh_, face)) {
      const bool is_repeated = !corners_.empty() && mesh_.origin(corners_.back()) == mesh_.origin(h);
      if (!is_repeated || mesh_.degree(face) == 3) corners_.push_back(h);
    }
    while (corners_.size() > 1 && mesh_.degree(face) != 3 && mesh_.origin(corners_.back()) == mesh_.origin(corners_[0]))
      corners_.pop_back();
  }

  std::vector<IndexTriangle> triangles_of_corners() {
    const std::array<View, 6> views = views_of(normal());
    if (is_convex(views[0])) return fan();
    if (number_points())
      for (const View& view : views)
        if (auto triangles = projected_triangles(view); !triangles.empty()) return triangles;
    std::vector<Vec3> loop;
    for (std::size_t i = 0; i < corners_.size(); ++i) loop.push_back(approx(i));
    return triangulate_loop({loop, loop}, LoopMeasure::area);
  }

  /// The vector area times a positive factor, in doubles of any size. Source: [newell1972], as sums of cross products.
  Vec3 normal() {
    collect_spokes();
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < spokes_.size(); ++i) sum = sum + cross(spokes_[i], spokes_[i + 1]);
    return sum;
  }

  /// The vectors from the first corner to all, times a power of two that makes the longest about 1: so their products
  /// neither overflow nor vanish.
  void collect_spokes() {
    const auto size_of = [](const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    double size = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) size = std::max(size, size_of(approx(i)));
    // Differences of large numbers may be beyond the range; halves of small ones may vanish.
    const double half = size > 1 ? 0.5 : 1;
    spokes_.clear();
    double longest = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      spokes_.push_back(half * approx(i) - half * approx(0));
      longest = std::max(longest, size_of(spokes_.back()));
    }
    if (longest == 0) return;
    const int exponent = -std::ilogb(longest);
    for (Vec3& v : spokes_) v = {std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent)};
  }

  /// Along the axes, the one nearest to the normal first; the last three look from the other side, for normals that
  /// rounding has turned.
  static std::array<View, 6> views_of(const Vec3& normal) {
    std::array<std::size_t, 3> axes{2, 1, 0};
    std::ranges::stable_sort(axes, std::ranges::greater(), [&](std::size_t axis) { return std::abs(normal[axis]); });
    std::array<View, 6> views{};
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t axis = axes[i % 3];
      views[i] = {static_cast<Projection>(axis), (normal[axis] < 0) == (i < 3)};
    }
    return views;
  }

  bool turns_left(const View& view, std::size_t a, std::size_t b, std::size_t c) const {
    return orient2d(view.projection, point(a), point(b), point(c)) == (view.is_flipped ? -1 : 1);
  }
  bool is_convex(const View& view) const {
    const std::size_t n = corners_.size();
    for (std::size_t i = 0; i < n; ++i)
      if (!turns_left(view, i, (i + 1) % n, (i + 2) % n)) return false;
    // A star turns one way as well, but more than once round.
    for (std::size_t i = 1; i + 1 < n; ++i)
      if (!turns_left(view, 0, i, i + 1)) return false;
    return true;
  }

  std::vector<IndexTriangle> fan() const {
    std::vector<IndexTriangle> triangles;
    for (std::uint32_t i = 1; i + 1 < corners_.size(); ++i) triangles.push_back({0, i, i + 1});
    return triangles;
  }

  /// Numbers the corners in their order; false if two are the same point.
  bool number_points() {
    points_ = PointTable(corners_.size());
    for (std::size_t i = 0; i < corners_.size(); ++i) points_.intern(point(i));
    return points_.size() == corners_.size();
  }

  /// Empty if the face touches or crosses itself in the projection.
  std::vector<IndexTriangle> projected_triangles(const View& view) const {
    std::vector<DirectedEdge> edges;
    for (std::uint32_t from = 0; from < corners_.size(); ++from) {
      const auto to = static_cast<std::uint32_t>((from + 1) % corners_.size());
      edges.push_back(view.is_flipped ? DirectedEdge(to, from) : DirectedEdge(from, to));
    }
    std::vector<IndexTriangle> triangles;
    if (!triangulate_by_sweep(points_, view.projection, edges, triangles) || triangles.size() + 2 != corners_.size())
      return {};
    for (IndexTriangle& triangle : triangles) {
      if (view.is_flipped) std::swap(triangle[1], triangle[2]);
      std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    }
    return triangles;
  }

  const PolygonMesh& mesh_;
  std::vector<HalfedgeId> corners_;
  std::vector<Vec3> spokes_;
  PointTable points_;
};

}  // namespace

Result<std::vector<CornerTriangle>> triangulate_faces(const PolygonMesh& mesh, const Monitor& monitor) {
  std::vector<CornerTriangle> triangles;
  triangles.reserve(mesh.halfedge_count() - std::min(mesh.halfedge_count(), 2 * mesh.face_count()));
  FaceTriangulator triangulator(mesh);
  Stage stage(monitor, "triangulating faces", mesh.face_count());
  for (const FaceId f : faces(mesh)) {
    if (!stage.begin_step()) return Monitor::interrupted();
    triangulator.triangulate(f, triangles);
  }
  return triangles;
}

}  // namespace algebra3d
