#include "algebra3d/repair/rounded_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/repair/pressed_sheets.h"
#include "algebra3d/repair/snapped_mesh.h"
#include "algebra3d/repair/winding_solid.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

constexpr int kMaxStages = 12;
constexpr int kAttemptsPerStage = 3;
/// The radius of the ball about a corner of a cubic pixel's length, out to the middle.
constexpr double kHalfDiagonal = 0.8661;

/// Slivers that cross each other may do so ever more often; more triangles than this are no solid that anybody wants.
std::size_t max_faces(const TriangleMesh& solid) {
  return 2 * solid.face_count() + 1000;
}

/// An upper bound of the distance between a point and the doubles to which it is rounded.
double distance(const PointRef& point, const Vec3& rounded) {
  Vec3 difference;
  for (std::size_t axis = 0; axis < 3; ++axis)
    difference[axis] = point.is_double() ? point.approx[axis] - rounded[axis]
                                         : ((*point.exact)[axis] - Rational(rounded[axis])).nearest_double();
  // Three roundings in the length, one in each difference.
  return std::hypot(difference.x, difference.y, difference.z) * (1 + 8 * std::numeric_limits<double>::epsilon());
}

/// Of a length that a few roundings may have made too small.
double rounded_up(double length) {
  return length * (1 + 0x1p-40);
}

double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Vec3& p : mesh.points().approx())
    for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
  return largest;
}

struct RoundedVertices : MovedVertices {
  std::size_t moved = 0;
  double largest_movement = 0;
  bool are_finite = true;
};

/// A rounding of all vertices that came out as no solid, or as one.
struct Attempt {
  TriangleMesh mesh;
  double largest_movement = 0;
  bool is_valid = false;
};

class Rounding {
 public:
  Rounding(const TriangleMesh& solid, const CoordinateGrid& grid, const std::atomic<bool>* cancel)
      : solid_(solid), grid_(grid), cancel_(cancel), spacing_(grid.spacing_up_to(largest_coordinate(solid))) {}

  Result<RoundedSolid> run();

 private:
  RoundedVertices rounded_vertices() const;
  Result<Attempt> attempt(const RoundedVertices& vertices);
  Status mark_crowded(const TriangleMesh& rounded, const PointArray& vertices);
  bool press(double reach);
  Status untangle(Attempt rounded, int stage);

  const TriangleMesh& solid_;
  CoordinateGrid grid_;
  const std::atomic<bool>* cancel_;
  double spacing_;           // of the grid, where it is widest
  TriangleMesh current_;     // a valid volume
  double moved_before_ = 0;  // how far it is from the given one, at most
  /// Per vertex of it: 0, or the pixels of the vertex are 2^(level - 1) spacings wide.
  std::vector<int> levels_;
};

/// Vertices that have not found their place are rounded to a coarser grid, so that what is crowded there merges.
RoundedVertices Rounding::rounded_vertices() const {
  RoundedVertices result;
  std::vector<Vec3> rounded;
  for (std::size_t i = 0; i < current_.vertex_count(); ++i) {
    const PointRef given = current_.points()[i];
    const double pixel = std::ldexp(spacing_, levels_[i] - 1);
    const CoordinateGrid grid = levels_[i] > 0 ? CoordinateGrid::multiples(pixel) : grid_;
    const Vec3 point{grid.nearest(given.approx.x), grid.nearest(given.approx.y), grid.nearest(given.approx.z)};
    result.are_finite = result.are_finite && is_finite(point);
    if (!result.are_finite) return result;
    const bool is_moved = !given.is_double() || given.approx != point;
    const double movement = is_moved ? distance(given, point) : 0;
    if (is_moved) ++result.moved;
    result.largest_movement = std::max(result.largest_movement, movement);
    result.movements.push_back(levels_[i] > 0 ? std::max(movement, kHalfDiagonal * pixel) : movement);
    rounded.push_back(point);
  }
  result.points = PointArray(std::move(rounded));
  return result;
}

Result<Attempt> Rounding::attempt(const RoundedVertices& vertices) {
  SnappedMesh snapped = snapped_mesh(current_, vertices);
  const double movement = rounded_up(vertices.largest_movement + snapped.largest_detour);
  ASSIGN_OR_RETURN(const ValidityReport report,
                   prove_volume(snapped.mesh, {.thoroughness = Thoroughness::first_defect, .cancel = cancel_}));
  return Attempt{std::move(snapped.mesh), moved_before_ + movement, report.is_valid()};
}

/// The corners of triangles that pass through others get wider pixels.
Status Rounding::mark_crowded(const TriangleMesh& rounded, const PointArray& vertices) {
  ASSIGN_OR_RETURN(const std::vector<Entanglement> entanglements, disentangle(rounded, cancel_));
  std::set<Vec3> crowded;
  for (std::uint32_t f = 0; f < rounded.face_count(); ++f)
    if (entanglements[f] != Entanglement::none)
      for (const PointRef& corner : rounded.corners(FaceId(f))) crowded.insert(corner.approx);
  for (std::size_t v = 0; v < levels_.size(); ++v)
    if (crowded.contains(vertices.approx()[v])) ++levels_[v];
  return {};
}

/// Facets that nearly touch do so exactly. False if there are none.
bool Rounding::press(double reach) {
  std::vector<bool> in_question;
  for (const int level : levels_) in_question.push_back(level > 0);
  const MovedVertices pressed = pressed_sheets(current_, in_question, reach);
  const double farthest = std::ranges::max(pressed.movements);
  if (farthest == 0) return false;
  SnappedMesh snapped = snapped_mesh(current_, pressed);
  moved_before_ += rounded_up(farthest + snapped.largest_detour);
  current_ = std::move(snapped.mesh);
  return true;
}

/// Another solid nearby that may be easier to round. Pressing makes coordinates with more digits, so it is not done
/// twice running.
Status Rounding::untangle(Attempt rounded, int stage) {
  const bool may_press = stage % 2 == 0;
  if (!may_press || !press(std::ldexp(spacing_, 1 + stage / 2))) {
    moved_before_ = rounded.largest_movement;
    current_ = std::move(rounded.mesh);
  }
  ASSIGN_OR_RETURN(current_, winding_solid(
                                 current_, [](int winding) { return winding > 0; }, cancel_));
  return {};
}

Result<RoundedSolid> Rounding::run() {
  RoundedSolid result;
  current_ = solid_;
  for (int stage = 0; stage < kMaxStages && current_.face_count() <= max_faces(solid_); ++stage) {
    levels_.assign(current_.vertex_count(), 0);
    Attempt first;
    for (int i = 0; i < kAttemptsPerStage; ++i) {
      const RoundedVertices vertices = rounded_vertices();
      if (!vertices.are_finite) {
        result.reason = "a coordinate is out of range";
        return result;
      }
      if (stage == 0 && i == 0) result.moved_vertices = vertices.moved;
      if (result.moved_vertices == 0) {
        result.mesh = solid_;
        return result;
      }
      ASSIGN_OR_RETURN(Attempt rounded, attempt(vertices));
      if (rounded.is_valid) {
        result.mesh = std::move(rounded.mesh);
        result.largest_movement = rounded.largest_movement;
        return result;
      }
      ++result.attempts_failed;
      RETURN_IF_ERROR(mark_crowded(rounded.mesh, vertices.points));
      if (i == 0) first = std::move(rounded);
    }
    RETURN_IF_ERROR(untangle(std::move(first), stage));
  }
  result.reason = "no rounding was found that keeps the solid free of self-intersections";
  return result;
}

}  // namespace

double CoordinateGrid::spacing_up_to(double size) const {
  const int exponent = size > 0 ? std::ilogb(size) : 0;
  switch (kind_) {
    case Kind::doubles:
      return std::ldexp(1, std::max(exponent - 52, -1074));
    case Kind::floats:
      return std::ldexp(1, std::max(exponent - 23, -149));
    default:
      return step_;
  }
}

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
  return Rounding(solid, grid, cancel).run();
}

}  // namespace algebra3d
