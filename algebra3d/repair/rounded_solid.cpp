#include "algebra3d/repair/rounded_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/opposite_triangles.h"
#include "algebra3d/repair/pressed_sheets.h"
#include "algebra3d/repair/scaled_triangles.h"
#include "algebra3d/repair/snapped_mesh.h"
#include "algebra3d/repair/winding_solid.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

constexpr int kMaxDivisions = 4;
constexpr int kMaxStages = 12;
constexpr int kAttemptsPerStage = 3;
/// Of a cube, in terms of its edge: no point of a pixel is farther from the middle.
constexpr double kHalfDiagonal = 0.8661;

/// Of triangles that may touch. Those that a rounding has folded may all do so; it is hopeless then.
std::size_t max_pairs(const TriangleMesh& mesh) {
  return 100 * mesh.face_count() + 100'000;
}

/// Slivers that cross each other may do so ever more often; more triangles than this are no solid that anybody wants.
std::size_t max_faces(const TriangleMesh& solid) {
  return solid.face_count() + solid.face_count() / 4 + 250;
}

/// An upper bound of the distance between a point and the doubles to which it is rounded.
double distance(const PointRef& point, const Vec3& rounded) {
  Vec3 difference;
  for (std::size_t axis = 0; axis < 3; ++axis)
    difference[axis] = point.is_double() ? point.approx[axis] - rounded[axis]
                                         : (point.coordinate(axis) - Rational(rounded[axis])).nearest_double();
  // Three roundings in the length, one in each difference, which may come down to nothing.
  const double length = std::hypot(difference.x, difference.y, difference.z);
  return length * (1 + 8 * std::numeric_limits<double>::epsilon()) + std::numeric_limits<double>::denorm_min();
}

/// Of a length that a few roundings may have made too small.
double rounded_up(double length) {
  return length * (1 + 0x1p-40);
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
  Result<bool> divide_at_itself();
  Result<bool> snap_and_press();

  void begin_anew();
  RoundedVertices rounded_vertices() const;
  Result<Attempt> attempt(SnappedMesh rounded, const RoundedVertices& vertices);
  Status mark_crowded(const TriangleMesh& rounded, const PointArray& vertices);
  bool press(double reach);
  Result<bool> take_inside_of(const TriangleMesh& mesh);

  const TriangleMesh& solid_;
  CoordinateGrid grid_;
  const std::atomic<bool>* cancel_;
  double spacing_;           // of the grid, where it is widest
  TriangleMesh current_;     // a valid volume
  double moved_before_ = 0;  // how far it is from the given one, at most
  /// Per vertex of it: 0, or the pixels of the vertex are 2^(level - 1) spacings wide.
  std::vector<int> levels_;
  RoundedSolid result_;
};

void Rounding::begin_anew() {
  current_ = solid_;
  moved_before_ = 0;
  levels_.assign(solid_.vertex_count(), 0);
}

/// Vertices that have not found their place are rounded to a coarser grid, so that what is crowded there merges.
RoundedVertices Rounding::rounded_vertices() const {
  RoundedVertices result;
  std::vector<Vec3> rounded;
  for (std::size_t i = 0; i < current_.vertex_count(); ++i) {
    const PointRef given = current_.points()[i];
    const double pixel = std::ldexp(spacing_, levels_[i] - 1);
    const CoordinateGrid wide = CoordinateGrid::multiples(pixel);
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = grid_.nearest(levels_[i] > 0 ? wide.nearest(given.approx[axis]) : given.approx[axis]);
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

/// A valid result is kept.
Result<Attempt> Rounding::attempt(SnappedMesh rounded, const RoundedVertices& vertices) {
  const double movement = moved_before_ + rounded_up(vertices.largest_movement + rounded.largest_detour);
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = cancel_};
  ASSIGN_OR_RETURN(const ValidityReport report, prove_volume(rounded.mesh, options));
  if (!report.is_valid()) {
    ++result_.attempts_failed;
    return Attempt{std::move(rounded.mesh), movement, false};
  }
  result_.mesh = std::move(rounded.mesh);
  result_.largest_movement = movement;
  return Attempt{{}, movement, true};
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

/// False if there is too much to be divided.
Result<bool> Rounding::take_inside_of(const TriangleMesh& mesh) {
  const auto is_inside = [](int winding) { return winding > 0; };
  auto solid = winding_solid(mesh, is_inside, cancel_, {Closure::together, max_pairs(mesh)});
  if (!solid.ok() && solid.error().code == ErrorCode::limit_exceeded) return false;
  if (!solid.ok()) return std::move(solid).error();
  current_ = *std::move(solid);
  levels_.assign(current_.vertex_count(), 0);
  return true;
}

/// Moves vertices by half a pixel and nothing farther: best where the grid is coarse for the solid. Where triangles are
/// long and thin, they multiply.
Result<bool> Rounding::divide_at_itself() {
  for (int i = 0; i < kMaxDivisions && current_.face_count() <= max_faces(solid_); ++i) {
    const RoundedVertices vertices = rounded_vertices();
    ASSIGN_OR_RETURN(Attempt moved, attempt(moved_mesh(current_, vertices.points), vertices));
    if (moved.is_valid) return true;
    moved_before_ = moved.largest_movement;
    ASSIGN_OR_RETURN(const bool is_divided, take_inside_of(moved.mesh));
    if (!is_divided) return false;
  }
  return false;
}

/// Pressing makes coordinates with more digits, so it is not done twice running.
Result<bool> Rounding::snap_and_press() {
  for (int stage = 0; stage < kMaxStages && current_.face_count() <= 2 * max_faces(solid_); ++stage) {
    std::optional<Attempt> first;
    for (int i = 0; i < kAttemptsPerStage; ++i) {
      const RoundedVertices vertices = rounded_vertices();
      if (!vertices.are_finite) return false;
      SnappedMesh rounded = snapped_mesh(current_, vertices);
      rounded.mesh = without_opposite_triangles(rounded.mesh);
      ASSIGN_OR_RETURN(Attempt snapped, attempt(std::move(rounded), vertices));
      if (snapped.is_valid) return true;
      RETURN_IF_ERROR(mark_crowded(snapped.mesh, vertices.points));
      if (!first) first = std::move(snapped);
    }
    if (stage % 2 != 0 || !press(std::ldexp(spacing_, 1 + stage / 2))) {
      moved_before_ = first->largest_movement;
      current_ = std::move(first->mesh);
    }
    ASSIGN_OR_RETURN(const bool is_divided, take_inside_of(current_));
    if (!is_divided) return false;
  }
  return false;
}

Result<RoundedSolid> Rounding::run() {
  begin_anew();
  const RoundedVertices vertices = rounded_vertices();
  result_.moved_vertices = vertices.moved;
  if (!vertices.are_finite) {
    result_.reason = "a coordinate is out of range";
    return result_;
  }
  if (vertices.moved == 0) {
    result_.mesh = solid_;
    return result_;
  }
  ASSIGN_OR_RETURN(const Attempt snapped, attempt(snapped_mesh(current_, vertices), vertices));
  if (snapped.is_valid) return std::move(result_);
  for (const auto way : {&Rounding::divide_at_itself, &Rounding::snap_and_press}) {
    begin_anew();
    ASSIGN_OR_RETURN(const bool is_found, (this->*way)());
    if (is_found) return std::move(result_);
  }
  result_.reason = "no rounding was found that keeps the solid free of self-intersections";
  return std::move(result_);
}

}  // namespace

Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid,
                                   const std::atomic<bool>* cancel) {
  ASSIGN_OR_RETURN(RoundedSolid rounded, Rounding(solid, grid, cancel).run());
  if (!rounded.mesh || rounded.moved_vertices == 0) return rounded;
  rounded.shells_before = connected_components(solid).count;
  rounded.shells_after = connected_components(*rounded.mesh).count;
  return rounded;
}

}  // namespace algebra3d
