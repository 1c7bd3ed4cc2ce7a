#include "algebra3d/rounding/rounded_solid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/operand.h"
#include "algebra3d/autorefinement/winding_selection.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/rounding/detail/coplanar_snapping.h"
#include "algebra3d/rounding/detail/opposite_triangles.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"
#include "algebra3d/rounding/detail/snap_rounding.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

constexpr int kMaxDivisions = 4;
constexpr int kMaxStages = 12;
constexpr int kAttemptsPerStage = 3;

/// A limit of the pairs of triangles that may touch. If a rounding has folded them, all may do so; that is hopeless.
std::size_t max_pairs(const TriangleMesh& mesh) {
  return 100 * mesh.face_count() + 100'000;
}

/// A limit of the triangles of a result: slivers that cross each other may do so ever more often.
std::size_t max_faces(const TriangleMesh& solid) {
  return solid.face_count() + solid.face_count() / 4 + 250;
}

/// A rounding of all vertices. If it gave a valid volume, that is kept, and the mesh is empty.
struct RoundingAttempt {
  TriangleMesh mesh;
  double largest_movement = 0;
  bool is_valid = false;
};

class Rounding {
 public:
  Rounding(const TriangleMesh& solid, const CoordinateGrid& grid, const std::atomic<bool>* cancel)
      : solid_(solid), grid_(grid), cancel_(cancel), pixels_{grid.spacing_up_to(largest_coordinate(solid)), {}} {}

  Result<RoundedSolid> run();

 private:
  Result<bool> round_and_divide();
  Result<bool> snap_and_divide();

  void begin_anew();
  RoundedVertices rounded() const { return rounded_vertices(current_, grid_, pixels_); }
  Result<RoundingAttempt> attempt(SnappedMesh rounded, const RoundedVertices& vertices);
  Result<std::optional<RoundingAttempt>> attempts_with_wider_pixels();
  Status widen_crowded_pixels(const TriangleMesh& rounded, const PointArray& vertices);
  bool make_coplanar(double reach);
  Result<bool> divide_at_itself(const TriangleMesh& mesh);

  const TriangleMesh& solid_;
  CoordinateGrid grid_;
  const std::atomic<bool>* cancel_;
  TriangleMesh current_;     // a valid volume
  PixelLevels pixels_;       // of its vertices
  double moved_before_ = 0;  // how far it is from the given one, at most
  RoundedSolid result_;
};

void Rounding::begin_anew() {
  current_ = solid_;
  moved_before_ = 0;
  pixels_.levels.assign(solid_.vertex_count(), 0);
}

Result<RoundingAttempt> Rounding::attempt(SnappedMesh rounded, const RoundedVertices& vertices) {
  const double movement = moved_before_ + rounded_up(vertices.largest_movement + rounded.largest_detour);
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = cancel_};
  ALGEBRA3D_ASSIGN_OR_RETURN(const ValidityReport report, prove_volume(rounded.mesh, options));
  if (!report.is_valid()) {
    ++result_.attempts_failed;
    return RoundingAttempt{std::move(rounded.mesh), movement, false};
  }
  result_.mesh = std::move(rounded.mesh);
  result_.largest_movement = movement;
  return RoundingAttempt{{}, movement, true};
}

/// Widens the pixels at the corners of triangles that cross others.
Status Rounding::widen_crowded_pixels(const TriangleMesh& rounded, const PointArray& vertices) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<Entanglement> entanglements, disentangle(rounded, cancel_));
  std::set<Vec3> crowded;
  for (const FaceId face : faces(rounded))
    if (entanglements[face.index()] != Entanglement::none)
      for (const PointRef& corner : rounded.corners(face)) crowded.insert(corner.approx);
  for (std::size_t v = 0; v < pixels_.levels.size(); ++v)
    if (crowded.contains(vertices.approx()[v])) ++pixels_.levels[v];
  return {};
}

/// Makes facets with crowded vertices coplanar that nearly are. False if there are none.
bool Rounding::make_coplanar(double reach) {
  std::vector<bool> in_question;
  for (const int level : pixels_.levels) in_question.push_back(level > 0);
  const MovedVertices moved = snap_coplanar(current_, in_question, reach);
  const double farthest = std::ranges::max(moved.movements);
  if (farthest == 0) return false;
  SnappedMesh snapped = snap_round(current_, moved);
  moved_before_ += rounded_up(farthest + snapped.largest_detour);
  current_ = std::move(snapped.mesh);
  return true;
}

/// Divides the mesh at itself, and goes on with the cells of positive winding number. False if that is too much.
Result<bool> Rounding::divide_at_itself(const TriangleMesh& mesh) {
  const auto is_inside = [](int winding) { return winding > 0; };
  auto solid = solid_by_winding(mesh, is_inside, cancel_, {Closure::together, max_pairs(mesh)});
  if (!solid.ok() && solid.error().code == ErrorCode::limit_exceeded) return false;
  if (!solid.ok()) return std::move(solid).error();
  current_ = *std::move(solid);
  pixels_.levels.assign(current_.vertex_count(), 0);
  return true;
}

/// Moves vertices by half a pixel and nothing farther: best where the grid is coarse for the solid. Where triangles are
/// long and thin, they multiply.
Result<bool> Rounding::round_and_divide() {
  for (int i = 0; i < kMaxDivisions && current_.face_count() <= max_faces(solid_); ++i) {
    const RoundedVertices vertices = rounded();
    ALGEBRA3D_ASSIGN_OR_RETURN(RoundingAttempt moved, attempt(moved_mesh(current_, vertices.points), vertices));
    if (moved.is_valid) return true;
    moved_before_ = moved.largest_movement;
    ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_divided, divide_at_itself(moved.mesh));
    if (!is_divided) return false;
  }
  return false;
}

/// Snap rounds a few times, with wider pixels each time where triangles cross. The first attempt if none was valid,
/// otherwise the valid one; none if a coordinate is out of range.
Result<std::optional<RoundingAttempt>> Rounding::attempts_with_wider_pixels() {
  std::optional<RoundingAttempt> first;
  for (int i = 0; i < kAttemptsPerStage; ++i) {
    const RoundedVertices vertices = rounded();
    if (!vertices.are_finite) return std::optional<RoundingAttempt>();
    SnappedMesh snapped = snap_round(current_, vertices);
    snapped.mesh = without_opposite_triangles(snapped.mesh);
    ALGEBRA3D_ASSIGN_OR_RETURN(RoundingAttempt made, attempt(std::move(snapped), vertices));
    if (made.is_valid) return std::optional(std::move(made));
    ALGEBRA3D_RETURN_IF_ERROR(widen_crowded_pixels(made.mesh, vertices.points));
    if (!first) first = std::move(made);
  }
  return first;
}

/// Facets are made coplanar in every second stage only, since that makes coordinates with more digits.
Result<bool> Rounding::snap_and_divide() {
  for (int stage = 0; stage < kMaxStages && current_.face_count() <= 2 * max_faces(solid_); ++stage) {
    ALGEBRA3D_ASSIGN_OR_RETURN(std::optional<RoundingAttempt> made, attempts_with_wider_pixels());
    if (!made || made->is_valid) return made.has_value();
    if (stage % 2 != 0 || !make_coplanar(std::ldexp(pixels_.spacing, 1 + stage / 2))) {
      moved_before_ = made->largest_movement;
      current_ = std::move(made->mesh);
    }
    ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_divided, divide_at_itself(current_));
    if (!is_divided) return false;
  }
  return false;
}

Result<RoundedSolid> Rounding::run() {
  begin_anew();
  const RoundedVertices vertices = rounded();
  result_.moved_vertices = vertices.moved;
  if (!vertices.are_finite) {
    result_.reason = "a coordinate is out of range";
    return result_;
  }
  if (vertices.moved == 0) {
    result_.mesh = solid_;
    return result_;
  }
  ALGEBRA3D_ASSIGN_OR_RETURN(const RoundingAttempt snapped, attempt(snap_round(current_, vertices), vertices));
  if (snapped.is_valid) return std::move(result_);
  for (const auto way : {&Rounding::round_and_divide, &Rounding::snap_and_divide}) {
    begin_anew();
    ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_found, (this->*way)());
    if (is_found) return std::move(result_);
  }
  result_.reason = "no rounding was found that keeps the solid free of self-intersections";
  return std::move(result_);
}

}  // namespace

Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid,
                                   const std::atomic<bool>* cancel) {
  ALGEBRA3D_ASSIGN_OR_RETURN(RoundedSolid rounded, Rounding(solid, grid, cancel).run());
  if (!rounded.mesh || rounded.moved_vertices == 0) return rounded;
  rounded.shells_before = connected_components(solid).count;
  rounded.shells_after = connected_components(*rounded.mesh).count;
  return rounded;
}

}  // namespace algebra3d
