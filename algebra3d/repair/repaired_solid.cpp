#include "algebra3d/repair/repaired_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/cracks.h"
#include "algebra3d/repair/degenerate_facets.h"
#include "algebra3d/repair/facet_orientation.h"
#include "algebra3d/repair/holes.h"
#include "algebra3d/repair/kept_shells.h"
#include "algebra3d/repair/shell_orientation.h"
#include "algebra3d/repair/spatial_order.h"
#include "algebra3d/repair/tolerant_solid.h"
#include "algebra3d/repair/winding_solid.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

constexpr double kCrackPerDiagonal = 1e-4;

double diagonal(const FacetList& facets) {
  Box3 box;
  for (const TriangleMesh::Triangle& triangle : facets.triangles)
    for (const std::uint32_t corner : triangle) box.extend(facets.points[corner]);
  if (box.is_empty()) return 0;
  return std::hypot(box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z);
}

bool has_boundary(const TriangleMesh& mesh) {
  return !is_closed(mesh);
}

/// True if along every edge as many half-edges run one way as the other.
bool is_balanced(const TriangleMesh& mesh) {
  return is_closed(mesh) && is_consistently_oriented(mesh);
}

/// True if an edge has one facet, or several that do not balance each other. Two that do not are a matter of turning.
bool has_open_edges(const TriangleMesh& mesh) {
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh.nonmanifold_edge(n);
    const auto forward =
        std::ranges::count_if(edge, [&](HalfedgeId h) { return mesh.origin(h) == mesh.origin(edge[0]); });
    if (edge.size() != 2 && 2 * static_cast<std::size_t>(forward) != edge.size()) return true;
  }
  return has_boundary(mesh);
}

class Repair {
 public:
  Repair(const WeldedTriangles& welded, const RepairOptions& options, const Monitor& monitor)
      : options_(options), monitor_(monitor), facets_(welded) {}

  Result<RepairedSolid> run();

 private:
  void drop_facets();
  void mend_boundaries();
  void orient();
  Status close_holes();
  Status make_solid();
  Result<bool> take_if_valid();
  void report_lost_shells(const TriangleMesh& given);
  std::string reason_for_nothing() const;

  const RepairOptions& options_;
  Monitor monitor_;
  FacetList facets_;
  TriangleMesh solid_;
  RepairReport report_;
};

void Repair::drop_facets() {
  drop_degenerate_facets(facets_, report_);
  FacetList rest = facets_;
  RepairReport report = report_;
  drop_duplicate_facets(rest, report);
  if (rest.triangles.size() == facets_.triangles.size()) return;
  // Closed shells that share facets would be open without them, and winding numbers count them all.
  if (is_balanced(facets_.mesh()) && has_open_edges(rest.mesh())) return;
  facets_ = std::move(rest);
  report_ = std::move(report);
}

void Repair::mend_boundaries() {
  if (!has_boundary(facets_.mesh())) return;
  divide_edges(facets_, report_);
  if (!has_boundary(facets_.mesh())) return;
  const double tolerance = options_.crack_tolerance.value_or(kCrackPerDiagonal * diagonal(facets_));
  if (!(tolerance > 0)) return;
  close_cracks(facets_, tolerance, report_);
  drop_facets();
}

void Repair::orient() {
  if (facets_.mesh().nonmanifold_edge_count() > 0) orient_facets(facets_, report_);
}

Status Repair::close_holes() {
  if (!has_boundary(facets_.mesh())) return {};
  RETURN_IF_ERROR(
      algebra3d::close_holes(facets_, options_.largest_hole.value_or(diagonal(facets_)), report_, monitor_));
  drop_facets();
  return {};
}

/// As they are, they may be a solid.
Result<bool> Repair::take_if_valid() {
  TriangleMesh mesh = facets_.mesh();
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = monitor_.cancel()};
  ASSIGN_OR_RETURN(const ValidityReport found, prove_volume(mesh, options));
  if (!found.is_valid()) return false;
  solid_ = std::move(mesh);
  return true;
}

Status Repair::make_solid() {
  const bool is_closed = is_balanced(facets_.mesh());
  RETURN_IF_ERROR(orient_shells(facets_, report_, monitor_));
  if (is_closed) {
    ASSIGN_OR_RETURN(const bool is_valid, take_if_valid());
    if (is_valid) return {};
  }
  const TriangleMesh mesh = facets_.mesh();
  ASSIGN_OR_RETURN(const ValidParts parts, ValidParts::make(mesh, monitor_));
  for (const FaceId face : parts.lone_faces()) report_.add(RepairStep::intersections, facets_.middle(face.index()));
  const auto is_inside = [](int winding) { return winding > 0; };
  auto solid = is_closed ? winding_solid(parts, is_inside, monitor_, options_.pair_limit())
                         : tolerant_solid(facets_, parts, monitor_, options_.pair_limit(), options_.work_limit * 1e6);
  if (!solid) return std::move(solid).error();
  solid_ = *std::move(solid);
  report_lost_shells(mesh);
  return {};
}

/// Shells of which no corner is left.
void Repair::report_lost_shells(const TriangleMesh& given) {
  std::vector<Vec3> left;
  for (std::size_t i = 0; i < solid_.points().size(); ++i)
    if (solid_.points()[i].is_double()) left.push_back(solid_.points().approx()[i]);
  std::ranges::sort(left);
  for (const std::vector<FaceId>& shell : connected_components(given).faces()) {
    const auto is_left = [&](FaceId face) {
      return std::ranges::any_of(
          given.corners(face), [&](const PointRef& corner) { return std::ranges::binary_search(left, corner.approx); });
    };
    if (std::ranges::none_of(shell, is_left)) report_.add(RepairStep::inner_shells, given.corners(shell[0])[0].approx);
  }
}

std::string Repair::reason_for_nothing() const {
  if (const RepairEntry* open = report_.find(RepairStep::open_holes))
    return fmt::format("{} {} left open (near ({:.6g} {:.6g} {:.6g}))", open->count,
                       open->count == 1 ? "hole was" : "holes were", open->where.x, open->where.y, open->where.z);
  return "the facets enclose no volume";
}

Result<RepairedSolid> Repair::run() {
  const TriangleMesh given = facets_.mesh();
  if (is_balanced(given)) {
    ASSIGN_OR_RETURN(report_.volume_before, nearest_volume(given, monitor_));
  }
  drop_facets();
  mend_boundaries();
  orient();
  RETURN_IF_ERROR(close_holes());
  const Status made = make_solid();
  if (!made && made.error().code == ErrorCode::limit_exceeded)
    return RepairedSolid{std::nullopt, made.error().message, std::move(report_)};
  RETURN_IF_ERROR(made);
  ASSIGN_OR_RETURN(solid_, kept_shells(std::move(solid_), options_, report_, monitor_));
  ASSIGN_OR_RETURN(report_.volume_after, nearest_volume(solid_, monitor_));
  if (solid_.is_empty() && !facets_.triangles.empty())
    return RepairedSolid{std::nullopt, reason_for_nothing(), std::move(report_)};
  ASSIGN_OR_RETURN(const ValidityReport found, prove_volume(solid_, {.cancel = monitor_.cancel()}));
  if (!found.is_valid())
    return RepairedSolid{std::nullopt, "the repair gave no valid solid: " + found.text(), std::move(report_)};
  solid_ = in_spatial_order(solid_);
  return RepairedSolid{std::move(solid_), {}, std::move(report_)};
}

}  // namespace

Result<RepairedSolid> repaired_solid(const WeldedTriangles& welded, const RepairOptions& options,
                                     const Monitor& monitor) {
  return Repair(welded, options, monitor).run();
}

}  // namespace algebra3d
