#include "algebra3d/rounding/rounded_surface.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "algebra3d/arrangement/surface_arrangement.h"
#include "algebra3d/autorefinement/valid_parts.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/rounding/detail/feature_snapping.h"
#include "algebra3d/rounding/detail/met_cells.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"
#include "algebra3d/rounding/detail/snap_rounding.h"
#include "algebra3d/rounding/detail/square_cover.h"
#include "algebra3d/validity/contacts.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

/// How often features are joined within a small reach, and how often within any.
constexpr int kModestTurns = 4;
constexpr int kFarTurns = 4;
/// These reaches, in spacings of the grid.
constexpr double kModest = 32;
constexpr double kFar = 0x1p20;
/// Wider ones join what is not thinner than the grid, and may not leave nothing.
constexpr double kLargestReachToVanish = 2;

class SurfaceRounding {
 public:
  SurfaceRounding(const CoordinateGrid& grid, double spacing, const std::atomic<bool>* cancel)
      : grid_(grid), spacing_(spacing), cancel_(cancel) {}

  /// The mesh is the snap rounded surface.
  void begin(SnappedMesh snapped, double movement);
  Result<bool> is_valid() const;
  Status join_features(double largest_reach);
  Status divide_at_crossings();
  /// Puts faces of cubes in place of the surface; false if the type has no numbers beyond it.
  Result<bool> cover(const TriangleMesh& surface);
  Result<RoundedSurface> result(std::size_t moved_vertices) &&;

 private:
  CoordinateGrid grid_;
  double spacing_;
  const std::atomic<bool>* cancel_;
  TriangleMesh mesh_;
  double movement_ = 0, reach_ = 0;
  RoundingMethod method_ = RoundingMethod::vertices_moved;
};

void SurfaceRounding::begin(SnappedMesh snapped, double movement) {
  mesh_ = std::move(snapped.mesh);
  movement_ += rounded_up(movement + snapped.largest_detour);
  if (snapped.largest_detour > 0) method_ = std::max(method_, RoundingMethod::edges_led_round);
}

Result<bool> SurfaceRounding::is_valid() const {
  if (mesh_.is_empty() && reach_ > kLargestReachToVanish * spacing_) return false;
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = cancel_};
  ALGEBRA3D_ASSIGN_OR_RETURN(const ValidityReport report, prove_surface(mesh_, options));
  return report.is_valid();
}

Status SurfaceRounding::join_features(double largest_reach) {
  ALGEBRA3D_ASSIGN_OR_RETURN(FeatureSnappedMesh joined,
                             snap_features(mesh_, grid_, spacing_, largest_reach, cancel_, Folded::stays));
  mesh_ = std::move(joined.mesh);
  movement_ += joined.largest_displacement;
  reach_ = std::max(reach_, joined.reach);
  if (joined.reach > 0) method_ = std::max(method_, RoundingMethod::features_joined);
  return {};
}

/// Rounds the new vertices.
Status SurfaceRounding::divide_at_crossings() {
  const Monitor monitor(cancel_);
  ALGEBRA3D_ASSIGN_OR_RETURN(const ValidParts parts, ValidParts::make(mesh_, monitor));
  ALGEBRA3D_ASSIGN_OR_RETURN(const TriangleMesh divided, unite_surfaces(parts.operands(), monitor));
  const RoundedVertices vertices = rounded_vertices(divided, grid_);
  ALGEBRA3D_ASSIGN_OR_RETURN(SnappedMesh snapped, snap_round(divided, vertices, cancel_));
  begin(std::move(snapped), vertices.largest_movement);
  method_ = std::max(method_, RoundingMethod::crossings_divided);
  return {};
}

Result<bool> SurfaceRounding::cover(const TriangleMesh& surface) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::optional<MetCells> met,
                             finest_met_cells(surface, grid_, cell_budget(surface), cancel_));
  if (!met) return false;
  ALGEBRA3D_ASSIGN_OR_RETURN(mesh_, square_cover(surface, *met, cancel_));
  movement_ = met->lattice.diagonal();
  reach_ = 0;
  method_ = RoundingMethod::faces_of_cubes;
  return true;
}

Result<RoundedSurface> SurfaceRounding::result(std::size_t moved_vertices) && {
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto contacts, vertex_contacts(mesh_, cancel_));
  return RoundedSurface{std::move(mesh_), "", moved_vertices, movement_, method_, vertex_count_of(contacts), reach_};
}

}  // namespace

Result<RoundedSurface> rounded_surface(const TriangleMesh& surface, const CoordinateGrid& grid,
                                       const std::atomic<bool>* cancel) {
  const RoundedVertices vertices = rounded_vertices(surface, grid);
  if (!vertices.are_finite) return RoundedSurface{std::nullopt, kOutOfRange};
  if (vertices.moved == 0) return RoundedSurface{surface};
  SurfaceRounding rounding(grid, grid.spacing_up_to(largest_coordinate(surface)), cancel);
  ALGEBRA3D_ASSIGN_OR_RETURN(SnappedMesh snapped, snap_round(surface, vertices, cancel));
  rounding.begin(std::move(snapped), vertices.largest_movement);
  for (int turn = 0; turn < kModestTurns + kFarTurns; ++turn) {
    ALGEBRA3D_ASSIGN_OR_RETURN(bool is_valid, rounding.is_valid());
    if (!is_valid) {
      ALGEBRA3D_RETURN_IF_ERROR(rounding.join_features(turn < kModestTurns ? kModest : kFar));
      ALGEBRA3D_ASSIGN_OR_RETURN(is_valid, rounding.is_valid());
    }
    if (is_valid) return std::move(rounding).result(vertices.moved);
    ALGEBRA3D_RETURN_IF_ERROR(rounding.divide_at_crossings());
  }
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_covered, rounding.cover(surface));
  if (!is_covered) return RoundedSurface{std::nullopt, kOutOfRange};
  return std::move(rounding).result(vertices.moved);
}

}  // namespace algebra3d
