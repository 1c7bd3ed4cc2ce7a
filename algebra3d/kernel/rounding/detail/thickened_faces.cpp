#include "algebra3d/kernel/rounding/detail/thickened_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/base/int128.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

/// The coordinate of the normal of a triangle that is largest: by exact integers, since the normal of a needle is hard
/// to compute.
struct Direction {
  std::size_t axis;
  bool is_positive;
};

/// Nothing if the triangle has no area.
std::optional<Direction> direction_of(const TriangleRef& corners, double unit) {
  const auto difference = [&](std::size_t corner, std::size_t axis) {
    const double coordinate = corners[corner].approx[axis] / unit, origin = corners[0].approx[axis] / unit;
    return Int128{std::llround(coordinate)} - std::llround(origin);
  };
  Int128 largest = 0;
  Direction direction{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Int128 coordinate = difference(1, u) * difference(2, v) - difference(1, v) * difference(2, u);
    const Int128 size = coordinate < 0 ? -coordinate : coordinate;
    if (size > largest) {
      largest = size;
      direction = {axis, coordinate > 0};
    }
  }
  return largest > 0 ? std::optional(direction) : std::nullopt;
}

/// The triangle with its corners in ascending order, and whether it faces the same way as before.
std::pair<Triangle, bool> sorted(Triangle t) {
  bool faces_same = true;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (t[i] <= t[j]) return;
    std::swap(t[i], t[j]);
    faces_same = !faces_same;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {t, faces_same};
}

/// The triangles of the result while they are made.
class ThickenedMesh {
 public:
  ThickenedMesh(const TriangleMesh& mesh, double height) : mesh_(mesh), height_(height) {}

  void add(const Triangle& t) { add_moved(t, 0, 0); }
  /// Adds top and bottom of the prism over a triangle that faces in the direction of the axis.
  void add_prism(const Triangle& t, std::size_t axis);
  /// Adds the walls of all prisms. Where prisms of one direction share a wall, there is none.
  void add_walls();
  TriangleMesh mesh() const;

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // ascending

  std::uint32_t vertex(std::uint32_t v, std::size_t axis, double offset) {
    Vec3 place = mesh_.points().approx()[v];
    place[axis] += offset;
    return table_.intern(place);
  }
  void add_moved(const Triangle& t, std::size_t axis, double offset) {
    triangles_.push_back({vertex(t[0], axis, offset), vertex(t[1], axis, offset), vertex(t[2], axis, offset)});
  }
  void add_wall(const Edge& edge, std::size_t axis, bool runs_forth);

  const TriangleMesh& mesh_;
  double height_;
  PointTable table_;
  std::vector<Triangle> triangles_;
  /// By axis: of how many more prisms the edge is a side one way than the other.
  std::array<std::map<Edge, int>, 3> walls_;
};

void ThickenedMesh::add_prism(const Triangle& t, std::size_t axis) {
  add_moved(t, axis, height_);
  add_moved({t[0], t[2], t[1]}, axis, -height_);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t from = t[i], to = t[(i + 1) % 3];
    walls_[axis][std::minmax(from, to)] += from < to ? 1 : -1;
  }
}

/// Which way round the wall faces changes nothing about its triangles.
void ThickenedMesh::add_wall(const Edge& edge, std::size_t axis, bool runs_forth) {
  const std::uint32_t a = vertex(edge.first, axis, -height_), b = vertex(edge.second, axis, -height_),
                      c = vertex(edge.second, axis, height_), d = vertex(edge.first, axis, height_);
  triangles_.push_back(runs_forth ? Triangle{a, b, c} : Triangle{a, c, b});
  triangles_.push_back(runs_forth ? Triangle{a, c, d} : Triangle{a, d, c});
}

void ThickenedMesh::add_walls() {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const auto& [edge, count] : walls_[axis])
      for (int i = 0; i < std::abs(count); ++i) add_wall(edge, axis, count > 0);
}

TriangleMesh ThickenedMesh::mesh() const {
  std::vector<Vec3> points;
  points.reserve(table_.size());
  for (std::uint32_t i = 0; i < table_.size(); ++i) points.push_back(table_[i].approx);
  return {PointArray(std::move(points)), triangles_};
}

}  // namespace

TriangleMesh thickened_faces(const TriangleMesh& closed, const Thickness& thickness) {
  std::map<Triangle, int> counts;  // sorted; how many more face one way than the other
  for (const FaceId face : faces(closed)) {
    const auto [triangle, faces_same] = sorted(closed.triangle(face));
    counts[triangle] += faces_same ? 1 : -1;
  }
  ThickenedMesh result(closed, thickness.height);
  const PointArray& points = closed.points();
  for (const auto& [triangle, count] : counts) {
    const auto [a, b, c] = triangle;
    for (int i = 0; i < std::abs(count); ++i) result.add(count > 0 ? triangle : Triangle{a, c, b});
    if (const auto direction = direction_of({points[a], points[b], points[c]}, thickness.unit))
      result.add_prism(direction->is_positive ? triangle : Triangle{a, c, b}, direction->axis);
  }
  result.add_walls();
  return result.mesh();
}

}  // namespace algebra3d
