#include "algebra3d/rounding/rounded_solid.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/operand.h"
#include "algebra3d/autorefinement/winding_selection.h"
#include "algebra3d/exact/point_table.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/rounding/detail/coplanar_snapping.h"
#include "algebra3d/rounding/detail/feature_snapping.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"
#include "algebra3d/rounding/detail/snap_rounding.h"
#include "algebra3d/rounding/detail/solid_part.h"
#include "algebra3d/rounding/detail/vertex_removal.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

/// More crowded vertices are not made coplanar: that takes rationals, whose digits multiply where many facets are near.
constexpr std::ptrdiff_t kMaxCrowded = 1000;

/// How often a mesh is only divided at its crossings, before features are joined.
constexpr int kMaxDivisions = 4;

/// How often features are joined and cells selected in one rung; and how many crossings need not become fewer.
constexpr int kMaxTurns = 6;
constexpr std::size_t kToleratedCrossings = 20;

/// Vertices no farther from the surface than so many spacings are superfluous. With one, a chain of 2000 turned
/// intersections has twice as many triangles as it needs, with two a third more.
constexpr double kSuperfluous = 2;

/// Within which reach, in spacings of the grid, features are joined, and facets made coplanar: at first, how far before
/// other ways are tried, and at last. That of coplanar facets grows from rung to rung.
constexpr double kFirstReach = 2;
constexpr double kModestReach = 32;
constexpr double kLargestReach = 0x1p20;
constexpr double kReachGrowth = 4;

/// A limit of the pairs of triangles that may touch. If a rounding has folded them, all may do so; that is hopeless.
std::size_t max_pairs(const TriangleMesh& mesh) {
  return 100 * mesh.face_count() + 100'000;
}

/// A limit of the triangles of what is divided again.
std::size_t max_faces(const TriangleMesh& solid) {
  return solid.face_count() + solid.face_count() / 4 + 250;
}

/// A closed mesh, how far its points are from the given boundary at most, and within which reach features were joined.
struct MovedMesh {
  TriangleMesh mesh;
  double movement = 0;
  double reach = 0;
};

class Rounding {
 public:
  Rounding(const TriangleMesh& solid, const CoordinateGrid& grid, const std::atomic<bool>* cancel)
      : solid_(solid),
        grid_(grid),
        spacing_(grid.spacing_up_to(largest_coordinate(solid))),
        cancel_(cancel),
        part_(solid) {}

  Result<RoundedSolid> run();

 private:
  static MovedMesh snap_rounded(const TriangleMesh& solid, const RoundedVertices& vertices);
  void take_part(SolidPart part);
  Result<bool> round_part();
  Result<bool> round_whole();
  MovedMesh without_superfluous(const MovedMesh& moved) const;
  Result<bool> keep_if_valid(const MovedMesh& moved);
  Result<bool> keep_simplest(const MovedMesh& moved);
  Result<std::optional<TriangleMesh>> positive_cells(const TriangleMesh& mesh) const;
  Result<bool> divide_at_crossings();
  Result<bool> join_features(MovedMesh moved, double largest_reach);
  Result<bool> select_cells(MovedMesh& moved);
  Result<std::vector<bool>> crowded_vertices(const TriangleMesh& snapped, const RoundedVertices& vertices) const;
  Result<bool> join_coplanar(const std::vector<bool>& crowded, double reach, double largest_reach);

  const TriangleMesh& solid_;
  CoordinateGrid grid_;
  double spacing_;
  const std::atomic<bool>* cancel_;
  SolidPart part_;  // what is rounded now
  RoundedVertices vertices_;
  PointTable places_that_stay_;  // of vertices of the part of which no facet has a moved corner
  RoundedSolid result_;
};

MovedMesh Rounding::snap_rounded(const TriangleMesh& solid, const RoundedVertices& vertices) {
  SnappedMesh snapped = snap_round(solid, vertices);
  return {std::move(snapped.mesh), rounded_up(vertices.largest_movement + snapped.largest_detour)};
}

/// If the solid is valid with the mesh in place of the part, it becomes the result. Only the first rung may leave
/// nothing: a farther one would join walls that are thicker than the grid.
Result<bool> Rounding::keep_if_valid(const MovedMesh& moved) {
  if (moved.mesh.is_empty() && moved.reach > kFirstReach * spacing_) return false;
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_valid, part_.is_valid_with(moved.mesh, moved.movement, cancel_));
  if (!is_valid) return false;
  if (!part_.keeps_shells_with(moved.mesh)) result_.shells_before = connected_components(solid_).count;
  result_.mesh = part_.solid_with(moved.mesh);
  if (result_.shells_before > 0) result_.shells_after = connected_components(*result_.mesh).count;
  result_.largest_movement = moved.movement;
  result_.reach = moved.reach;
  return true;
}

/// Without corners of facets with moved corners that lie on the surface or on an edge anyway, up to two spacings of
/// the grid: rounding left them there, now or earlier. On a grid of multiples, which may be coarse for the solid, all
/// stay.
MovedMesh Rounding::without_superfluous(const MovedMesh& moved) const {
  if (!grid_.is_floating()) return moved;
  std::vector<bool> may_go;
  may_go.reserve(moved.mesh.vertex_count());
  for (const Vec3& place : moved.mesh.points().approx()) may_go.push_back(places_that_stay_.find(place) == kNone);
  TriangleMesh simpler = without_superfluous_vertices(moved.mesh, may_go, kSuperfluous * spacing_);
  if (simpler.face_count() == moved.mesh.face_count()) return moved;
  return {std::move(simpler), moved.movement + rounded_up(2 * kSuperfluous * spacing_), moved.reach};
}

Result<bool> Rounding::keep_simplest(const MovedMesh& moved) {
  const MovedMesh simpler = without_superfluous(moved);
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_valid, keep_if_valid(simpler));
  if (is_valid || simpler.mesh.face_count() == moved.mesh.face_count()) return is_valid;
  return keep_if_valid(moved);
}

/// Divides the mesh at its crossings, and keeps the cells with a positive winding number. Nothing if that is too much.
Result<std::optional<TriangleMesh>> Rounding::positive_cells(const TriangleMesh& mesh) const {
  const auto is_inside = [](int winding) { return winding > 0; };
  auto solid = solid_by_winding(mesh, is_inside, cancel_, {Closure::together, max_pairs(mesh)});
  if (!solid.ok() && solid.error().code == ErrorCode::limit_exceeded) return std::optional<TriangleMesh>();
  if (!solid.ok()) return std::move(solid).error();
  return std::optional(*std::move(solid));
}

/// Selects cells, and rounds the new corners. False if that is too much.
Result<bool> Rounding::select_cells(MovedMesh& moved) {
  ALGEBRA3D_ASSIGN_OR_RETURN(std::optional<TriangleMesh> solid, positive_cells(moved.mesh));
  if (!solid) return false;
  const RoundedVertices vertices = rounded_vertices(*solid, grid_);
  MovedMesh snapped = vertices.moved == 0 ? MovedMesh{*std::move(solid)} : snap_rounded(*solid, vertices);
  moved = {std::move(snapped.mesh), moved.movement + snapped.movement, moved.reach};
  return true;
}

/// The rung that moves least: vertices move and no edge is led round any, then cells are selected, a few times. Best
/// where the grid is coarse for the solid; where long thin triangles cross, they multiply.
Result<bool> Rounding::divide_at_crossings() {
  TriangleMesh solid = solid_;
  double moved_before = 0;
  for (int i = 0; i < kMaxDivisions && solid.face_count() <= max_faces(solid_); ++i) {
    const RoundedVertices vertices = rounded_vertices(solid, grid_);
    SnappedMesh snapped = moved_mesh(solid, vertices.points);
    const double movement = moved_before + rounded_up(vertices.largest_movement + snapped.largest_detour);
    const MovedMesh moved{std::move(snapped.mesh), movement};
    ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_valid, keep_simplest(moved));
    if (is_valid) return true;
    ALGEBRA3D_ASSIGN_OR_RETURN(std::optional<TriangleMesh> cells, positive_cells(moved.mesh));
    if (!cells) return false;
    solid = *std::move(cells);
    moved_before = movement;
  }
  return false;
}

/// One rung: joins features, and selects cells, in turns, as long as no more than some half of the crossings are left.
Result<bool> Rounding::join_features(MovedMesh moved, double largest_reach) {
  std::size_t most_crossings = SIZE_MAX;
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    ALGEBRA3D_ASSIGN_OR_RETURN(FeatureSnappedMesh joined,
                               snap_features(moved.mesh, grid_, spacing_, largest_reach, cancel_));
    moved = {std::move(joined.mesh), moved.movement + joined.largest_displacement, std::max(moved.reach, joined.reach)};
    if (joined.crossing_pairs == 0) {
      ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_valid, keep_simplest(moved));
      if (is_valid) return true;
    }
    const bool grows = moved.mesh.face_count() > 2 * max_faces(solid_);
    if (!part_.is_whole() || joined.crossings_before > most_crossings || grows) return false;
    most_crossings = joined.crossings_before / 2 + kToleratedCrossings;
    ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_selected, select_cells(moved));
    if (!is_selected) return false;
  }
  return false;
}

/// Which vertices of the solid are corners of triangles that cross others after snap rounding.
Result<std::vector<bool>> Rounding::crowded_vertices(const TriangleMesh& snapped,
                                                     const RoundedVertices& vertices) const {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<Entanglement> entanglements, disentangle(snapped, cancel_));
  std::set<Vec3> places;
  for (const FaceId face : faces(snapped))
    if (entanglements[face.index()] != Entanglement::none)
      for (const PointRef& corner : snapped.corners(face)) places.insert(corner.approx);
  std::vector<bool> are_crowded;
  for (const Vec3& place : vertices.points.approx()) are_crowded.push_back(places.contains(place));
  return are_crowded;
}

/// The same rung for a solid whose crowded facets are made exactly coplanar with others nearer than `reach`: facets
/// that nearly lie upon each other and are large have no near features. Then features are joined. False if there are
/// none, or too many.
Result<bool> Rounding::join_coplanar(const std::vector<bool>& crowded, double reach, double largest_reach) {
  if (std::ranges::count(crowded, true) > kMaxCrowded) return false;
  const MovedVertices moved = snap_coplanar(solid_, crowded, reach * spacing_);
  const double farthest = std::ranges::max(moved.movements);
  if (farthest == 0) return false;
  SnappedMesh snapped = snap_round(solid_, moved);
  MovedMesh coplanar{std::move(snapped.mesh), rounded_up(farthest + snapped.largest_detour), reach * spacing_};
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_selected, select_cells(coplanar));
  return is_selected ? join_features(std::move(coplanar), largest_reach) : Result<bool>(false);
}

void Rounding::take_part(SolidPart part) {
  part_ = std::move(part);
  const TriangleMesh& mesh = part_.mesh();
  vertices_ = rounded_vertices(mesh, grid_);
  if (!vertices_.are_finite) return;
  std::vector<bool> is_at_moved_facet(mesh.vertex_count());
  for (const FaceId face : faces(mesh)) {
    const TriangleMesh::Triangle corners = mesh.triangle(face);
    if (std::ranges::any_of(corners, [&](std::uint32_t v) { return vertices_.movements[v] > 0; }))
      for (const std::uint32_t v : corners) is_at_moved_facet[v] = true;
  }
  places_that_stay_ = PointTable(mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    if (!is_at_moved_facet[v]) places_that_stay_.intern(mesh.points()[v]);
}

/// The rungs that a part of the solid is enough for.
Result<bool> Rounding::round_part() {
  const MovedMesh snapped = snap_rounded(part_.mesh(), vertices_);
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_found, keep_simplest(snapped));
  return is_found || !grid_.is_floating() ? Result<bool>(is_found) : join_features(snapped, kModestReach);
}

/// All rungs. Where the grid may be coarse for the solid, dividing comes before joining; else it would only take time.
Result<bool> Rounding::round_whole() {
  const MovedMesh snapped = snap_rounded(solid_, vertices_);
  ALGEBRA3D_ASSIGN_OR_RETURN(bool is_found, keep_simplest(snapped));
  if (!is_found && !grid_.is_floating()) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, divide_at_crossings());
  }
  if (!is_found) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_features(snapped, kModestReach));
  }
  if (is_found) return true;
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<bool> crowded, crowded_vertices(snapped.mesh, vertices_));
  double reach = kFirstReach;
  for (; !is_found && reach <= kModestReach; reach *= kReachGrowth) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_coplanar(crowded, reach, kModestReach));
  }
  if (!is_found) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_features(snapped, kLargestReach));
  }
  for (; !is_found && reach <= kLargestReach; reach *= kReachGrowth) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, join_coplanar(crowded, reach, kLargestReach));
  }
  return is_found;
}

Result<RoundedSolid> Rounding::run() {
  const std::vector<bool> is_moved = are_moved(solid_, grid_);
  result_.moved_vertices = static_cast<std::size_t>(std::ranges::count(is_moved, true));
  if (result_.moved_vertices == 0) {
    result_.mesh = solid_;
    return std::move(result_);
  }
  take_part(SolidPart(solid_, is_moved));
  if (!vertices_.are_finite) {
    result_.reason = "a coordinate is out of range";
    return std::move(result_);
  }
  bool is_found = false;
  if (!part_.is_whole()) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, round_part());
    if (!is_found) take_part(SolidPart(solid_));
  }
  if (!is_found) {
    ALGEBRA3D_ASSIGN_OR_RETURN(is_found, round_whole());
  }
  if (!is_found) result_.reason = "no rounding was found that keeps the solid free of self-intersections";
  return std::move(result_);
}

}  // namespace

Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid,
                                   const std::atomic<bool>* cancel) {
  return Rounding(solid, grid, cancel).run();
}

}  // namespace algebra3d
