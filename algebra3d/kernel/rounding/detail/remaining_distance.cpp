#include "algebra3d/kernel/rounding/detail/remaining_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/kernel/distance/covering_bound.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// How many pieces the bound of the faces that are measured may take, a microsecond or two each.
constexpr std::size_t kMaxPiecesMeasured = 100'000;
/// Precision of that bound: faces that lie upon given ones are at next to no distance.
constexpr double kEnoughPerKnown = 0x1p-20;

/// The places of a face's corners by their numbers, ascending.
using Places = TriangleMesh::Triangle;

/// The given faces with rounded corners.
class MovedFaces {
 public:
  MovedFaces(const TriangleMesh& given, const RoundedVertices& vertices);

  /// How far the corners of the given face moved that has become this one: of several the one that moved least. Nothing
  /// if no given face has.
  std::optional<double> movement(const TriangleRef& face) const;

 private:
  MovedPoints points_;
  std::vector<std::pair<Places, double>> faces_;  // ascending
};

MovedFaces::MovedFaces(const TriangleMesh& given, const RoundedVertices& vertices) : points_(vertices) {
  faces_.reserve(given.face_count());
  for (const FaceId face : faces(given)) {
    const auto [a, b, c] = given.triangle(face);
    const auto place_of = [&](auto vertex) { return points_.of(VertexId(vertex)).index(); };
    Places places{place_of(a), place_of(b), place_of(c)};
    std::ranges::sort(places);
    faces_.emplace_back(places, std::max({vertices.movements[a], vertices.movements[b], vertices.movements[c]}));
  }
  std::ranges::sort(faces_);
}

std::optional<double> MovedFaces::movement(const TriangleRef& face) const {
  Places places{};
  std::ranges::transform(face, places.begin(), [&](const PointRef& corner) { return points_.table.find(corner); });
  std::ranges::sort(places);
  const auto found = std::ranges::lower_bound(faces_, std::pair(places, 0.0));
  return found != faces_.end() && found->first == places ? std::optional(found->second) : std::nullopt;
}

/// How far the coordinates of a mesh may be from the doubles nearest to them, as a distance.
double error_of_doubles(const TriangleMesh& mesh) {
  if (mesh.points().exact_count() == 0) return 0;
  return std::sqrt(3.0) * CoordinateGrid::doubles().spacing_up_to(largest_coordinate(mesh));
}

}  // namespace

Result<double> remaining_distance(const TriangleMesh& given, const TriangleMesh& rounded, const CoordinateGrid& grid,
                                  double known, const Monitor& monitor) {
  const MovedFaces moved(given, rounded_vertices(given, grid));
  double farthest = 0;
  std::vector<FaceId> others;
  for (const FaceId face : faces(rounded)) {
    if (const std::optional<double> movement = moved.movement(rounded.corners(face)))
      farthest = std::max(farthest, *movement);
    else
      others.push_back(face);
  }
  if (!others.empty() && farthest < known) {
    const BoxHierarchy hierarchy(given);
    A3D_ASSIGN(const std::optional<double> bound, covering_bound(submesh(rounded, others), {&given, &hierarchy},
                                                                 kEnoughPerKnown * known, kMaxPiecesMeasured, monitor));
    farthest = bound ? std::max(farthest, *bound + error_of_doubles(given)) : known;
  }
  return std::min(known, farthest > 0 ? rounded_up(farthest) : 0);
}

}  // namespace algebra3d
