#include "algebra3d/repair/rounded_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/repair/weld.h"
#include "algebra3d/repair/winding_solid.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

constexpr std::size_t kMaxRounds = 8;

/// Slivers that cross each other may do so ever more often from round to round; more triangles than this are no solid
/// that anybody wants.
std::size_t max_faces(const TriangleMesh& solid) {
  return 2 * solid.face_count() + 1000;
}

/// Points on the grid, and how far they are from the given ones.
struct RoundedPoints {
  std::vector<Vec3> points;
  std::size_t moved = 0;
  double largest_movement = 0;
  bool are_finite = true;
};

/// An upper bound of the distance between a point and the doubles to which it is rounded.
double distance(const PointRef& point, const Vec3& rounded) {
  Vec3 difference;
  for (std::size_t axis = 0; axis < 3; ++axis)
    difference[axis] = point.is_double() ? point.approx[axis] - rounded[axis]
                                         : ((*point.exact)[axis] - Rational(rounded[axis])).nearest_double();
  // Three roundings in the length, one in each difference.
  return std::hypot(difference.x, difference.y, difference.z) * (1 + 8 * std::numeric_limits<double>::epsilon());
}

RoundedPoints rounded(const PointArray& points, const CoordinateGrid& grid) {
  RoundedPoints result;
  result.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointRef given = points[i];
    const Vec3 point{grid.nearest(given.approx.x), grid.nearest(given.approx.y), grid.nearest(given.approx.z)};
    result.points.push_back(point);
    result.are_finite = result.are_finite && is_finite(point);
    if (!result.are_finite || (given.is_double() && given.approx == point)) continue;
    ++result.moved;
    result.largest_movement = std::max(result.largest_movement, distance(given, point));
  }
  return result;
}

/// The triangles over new points, of which some may have become equal; without those that lost a corner.
TriangleMesh moved(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
  std::vector<TriangleSoup::Triangle> soup;
  soup.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.triangle(FaceId(f));
    if (points[a] != points[b] && points[b] != points[c] && points[c] != points[a])
      soup.push_back({points[a], points[b], points[c]});
  }
  WeldedTriangles welded = weld(soup);
  return {std::move(welded.points), welded.triangles};
}

}  // namespace

double CoordinateGrid::nearest(double coordinate) const {
  switch (kind_) {
    case Kind::doubles:
      return coordinate;
    case Kind::floats:
      // Beyond the range the cast would be undefined.
      if (std::abs(coordinate) > std::numeric_limits<float>::max())
        return std::copysign(std::numeric_limits<double>::infinity(), coordinate);
      return static_cast<float>(coordinate);
    default: {
      // Far out the multiples are as dense as the doubles, or denser.
      constexpr double kFarOut = 4503599627370496;  // 2^52
      const double multiple = coordinate / step_;
      return std::abs(multiple) < kFarOut ? std::round(multiple) * step_ : coordinate;
    }
  }
}

Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid,
                                   const std::atomic<bool>* cancel) {
  RoundedSolid result;
  TriangleMesh current = solid;
  for (std::size_t round = 0; round < kMaxRounds && current.face_count() <= max_faces(solid); ++round) {
    const RoundedPoints points = rounded(current.points(), grid);
    if (!points.are_finite) {
      result.reason = "a coordinate is out of range";
      return result;
    }
    if (round == 0) {
      result.moved_vertices = points.moved;
      if (points.moved == 0) {
        result.mesh = solid;
        return result;
      }
    }
    result.largest_movement += points.largest_movement;
    current = moved(current, points.points);
    ASSIGN_OR_RETURN(const ValidityReport report,
                     prove_volume(current, {.thoroughness = Thoroughness::first_defect, .cancel = cancel}));
    if (report.is_valid()) {
      result.mesh = std::move(current);
      return result;
    }
    ++result.self_crossings_mended;
    ASSIGN_OR_RETURN(current, winding_solid(
                                  current, [](int winding) { return winding > 0; }, cancel));
  }
  result.reason = "no rounding was found that keeps the solid free of self-intersections";
  return result;
}

}  // namespace algebra3d
