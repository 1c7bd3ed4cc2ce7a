#include "algebra3d/repair/repaired_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/cracks.h"
#include "algebra3d/repair/degenerate_facets.h"
#include "algebra3d/repair/facet_orientation.h"
#include "algebra3d/repair/fins.h"
#include "algebra3d/repair/holes.h"
#include "algebra3d/repair/kept_shells.h"
#include "algebra3d/repair/rims.h"
#include "algebra3d/repair/shell_orientation.h"
#include "algebra3d/repair/spatial_order.h"
#include "algebra3d/repair/tolerant_solid.h"
#include "algebra3d/repair/valid_parts.h"
#include "algebra3d/repair/winding_solid.h"
#include "algebra3d/repair/work_limits.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

constexpr double kCrackPerDiagonal = 1e-4;

double diagonal(const FacetList& facets) {
  Box3 box;
  for (const TriangleMesh::Triangle& triangle : facets.triangles)
    for (const std::uint32_t corner : triangle) box.extend(facets.points[corner]);
  if (box.is_empty()) return 0;
  return length(box.max - box.min);
}

/// How far apart equal corners may be where somebody rounded them: a few floats, or a little of the size of the file.
double noise(const FacetList& facets) {
  constexpr double kNoisePerDiagonal = 1e-6;
  constexpr double kFloats = 4 * 0x1p-23;
  double farthest = 0;
  for (const TriangleMesh::Triangle& triangle : facets.triangles)
    for (const std::uint32_t corner : triangle)
      for (std::size_t axis = 0; axis < 3; ++axis)
        farthest = std::max(farthest, std::abs(facets.points[corner][axis]));
  return std::max(kNoisePerDiagonal * diagonal(facets), kFloats * farthest);
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
    if (edge.size() != 2 && !is_balanced(mesh, edge)) return true;
  }
  return has_boundary(mesh);
}

/// False for facets that are divided for the sake of their edges alone.
bool has_manifold_edges(const TriangleMesh& mesh, FaceId face) {
  for (std::uint32_t corner = 0; corner < 3; ++corner)
    if (!mesh.opposite(TriangleMesh::halfedge(face, corner)).is_valid()) return false;
  return true;
}

class Repair {
 public:
  Repair(std::shared_ptr<const TriangleMesh> given, const RepairOptions& options, const Monitor& monitor)
      : options_(options), monitor_(monitor), facets_(std::move(given)) {}

  Result<RepairedSolid> run(const ValidityReport& found);

 private:
  /// Until the facets change.
  const TriangleMesh& mesh() const { return *facets_.mesh(); }
  void drop_facets(bool has_degenerate, bool has_duplicates);
  void drop_what_became_flat();
  void mend_boundaries();
  void orient();
  Status close_holes();
  /// Whoever knows that facets cross spares the attempt to prove that they do not.
  Status make_solid(bool may_cross);
  Result<bool> take_if_valid();
  Status divide(const ValidParts& parts);
  void report_lost_shells();
  Result<bool> is_proved();
  RepairedSolid nothing(std::string reason) { return {std::nullopt, std::move(reason), std::move(report_)}; }
  std::string reason_for_nothing() const;

  const RepairOptions& options_;
  Monitor monitor_;
  FacetList facets_;
  TriangleMesh solid_;
  bool is_proved_ = false;
  RepairReport report_;
};

void Repair::drop_facets(bool has_degenerate, bool has_duplicates) {
  if (has_degenerate) drop_degenerate_facets(facets_, report_);
  if (!has_duplicates) return;
  FacetList rest = facets_;
  RepairReport report = report_;
  drop_duplicate_facets(rest, report);
  if (rest.triangles.size() == facets_.triangles.size()) return;
  // Closed shells that share facets would be open without them, and winding numbers count them all. Where half of them
  // or more would go, everything is double, and balances for that reason alone.
  const bool is_double = 2 * rest.triangles.size() <= facets_.triangles.size();
  if (!is_double && is_balanced(mesh()) && has_open_edges(*rest.mesh())) return;
  facets_ = std::move(rest);
  report_ = std::move(report);
}

/// Of facets that moved, or were added. The report is of what the file has.
void Repair::drop_what_became_flat() {
  RepairReport given = report_;
  drop_facets(true, true);
  report_ = std::move(given);
}

void Repair::mend_boundaries() {
  if (!has_boundary(mesh())) return;
  const double tolerance = options_.crack_tolerance.value_or(kCrackPerDiagonal * diagonal(facets_));
  join_equal_corners(facets_, std::min(tolerance, noise(facets_)), report_);
  drop_what_became_flat();
  if (!has_boundary(mesh())) return;
  divide_edges(facets_, report_);
  if (!has_boundary(mesh()) || !(tolerance > 0)) return;
  close_cracks(facets_, tolerance, report_);
  drop_what_became_flat();
}

void Repair::orient() {
  if (mesh().nonmanifold_edge_count() == 0) return;
  orient_facets(facets_, report_);
  if (has_boundary(mesh()) && mesh().nonmanifold_edge_count() > 0) drop_fins(facets_, report_);
}

Status Repair::close_holes() {
  // What covers a hole may be flat in part, and leave smaller ones where that is dropped.
  constexpr int kMostRounds = 4;
  const double largest = options_.largest_hole.value_or(diagonal(facets_));
  for (int round = 0; round < kMostRounds && has_boundary(mesh()); ++round) {
    if (round > 0) divide_edges(facets_, report_);
    const std::size_t facet_count = facets_.triangles.size();
    RETURN_IF_ERROR(algebra3d::close_holes(facets_, largest, report_, monitor_));
    RETURN_IF_ERROR(close_rims(facets_, largest, report_, monitor_));
    if (facets_.triangles.size() == facet_count || report_.find(RepairStep::open_holes) != nullptr) break;
    drop_what_became_flat();
  }
  drop_what_became_flat();
  return {};
}

/// As they are, they may be a solid.
Result<bool> Repair::take_if_valid() {
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = monitor_.cancel()};
  ASSIGN_OR_RETURN(const ValidityReport found, prove_volume(mesh(), options));
  is_proved_ = found.is_valid();
  if (is_proved_) solid_ = mesh();
  return is_proved_;
}

Status Repair::make_solid(bool may_cross) {
  RETURN_IF_ERROR(orient_shells(facets_, report_, monitor_));
  if (!may_cross) {
    ASSIGN_OR_RETURN(const bool is_valid, take_if_valid());
    if (is_valid) return {};
  }
  if (getenv("RFDBG")) {  // DEBUG
    int b = 0, u = 0;
    for (std::uint32_t h = 0; h < mesh().halfedge_count(); ++h) if (mesh().is_boundary(HalfedgeId(h))) { ++b; if (b < 20) fprintf(stderr, " b %u %u f%u (%g %g %g)\n", mesh().origin(HalfedgeId(h)).index(), mesh().target(HalfedgeId(h)).index(), h/3, mesh().point(mesh().origin(HalfedgeId(h))).approx.x, mesh().point(mesh().origin(HalfedgeId(h))).approx.y, mesh().point(mesh().origin(HalfedgeId(h))).approx.z); }
    for (std::size_t n = 0; n < mesh().nonmanifold_edge_count(); ++n) { auto e = mesh().nonmanifold_edge(n); if (!is_balanced(mesh(), e)) { ++u; if (u < 20) fprintf(stderr, " u%zu %u %u\n", e.size(), mesh().origin(e[0]).index(), mesh().target(e[0]).index()); } }
    fprintf(stderr, "boundary %d unbalanced %d of %zu\n", b, u, mesh().face_count());
  }  // DEBUG
  ASSIGN_OR_RETURN(const ValidParts parts, ValidParts::make(mesh(), monitor_));
  if (may_cross && parts.lone_faces().empty()) {
    ASSIGN_OR_RETURN(const bool is_valid, take_if_valid());
    if (is_valid) return {};
  }
  return divide(parts);
}

Status Repair::divide(const ValidParts& parts) {
  const bool is_closed = is_balanced(mesh());
  for (const FaceId face : parts.lone_faces())
    if (has_manifold_edges(mesh(), face)) report_.add(RepairStep::intersections, facets_.middle(face.index()));
  const auto is_inside = [](int winding) { return winding > 0; };
  auto solid = is_closed ? winding_solid(parts, is_inside, monitor_, work_limits(options_))
                         : tolerant_solid(facets_, parts, monitor_, work_limits(options_), options_.work_limit * 1e6);
  if (!solid) return std::move(solid).error();
  solid_ = *std::move(solid);
  report_lost_shells();
  return {};
}

/// Shells of which no corner is left.
void Repair::report_lost_shells() {
  std::vector<Vec3> left;
  for (std::size_t i = 0; i < solid_.points().size(); ++i)
    if (solid_.points()[i].is_double()) left.push_back(solid_.points().approx()[i]);
  std::ranges::sort(left);
  const TriangleMesh& given = mesh();
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
  if (const RepairEntry* sheets = report_.find(RepairStep::sheets))
    return fmt::format("{} (near ({:.6g} {:.6g} {:.6g}))",
                       sheets->count == 1 ? "the facets are a sheet" : "the facets are sheets", sheets->where.x,
                       sheets->where.y, sheets->where.z);
  return "the facets enclose no volume";
}

Result<bool> Repair::is_proved() {
  if (is_proved_) return true;
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = monitor_.cancel()};
  ASSIGN_OR_RETURN(const ValidityReport found, prove_volume(solid_, options));
  return found.is_valid();
}

Result<RepairedSolid> Repair::run(const ValidityReport& found) {
  if (is_balanced(mesh())) {
    ASSIGN_OR_RETURN(const double volume, nearest_volume(mesh(), monitor_));
    report_.volume_before = std::abs(volume);
  }
  drop_facets(found.count(Defect::degenerate_triangle) > 0, found.count(Defect::duplicate_triangle) > 0);
  mend_boundaries();
  orient();
  RETURN_IF_ERROR(close_holes());
  const Status made = make_solid(found.count(Defect::intersecting_triangles) > 0);
  if (!made && made.error().code == ErrorCode::limit_exceeded) return nothing(made.error().message);
  RETURN_IF_ERROR(made);
  if (solid_.is_empty() && !facets_.triangles.empty()) return nothing(reason_for_nothing());
  if (report_.find(RepairStep::open_holes) != nullptr && report_.find(RepairStep::inner_shells) != nullptr)
    return nothing(reason_for_nothing());
  ASSIGN_OR_RETURN(const TriangleMesh kept, kept_shells(solid_, options_, report_, monitor_));
  is_proved_ = is_proved_ && kept.face_count() == solid_.face_count();
  solid_ = in_spatial_order(kept);
  ASSIGN_OR_RETURN(const bool is_valid, is_proved());
  if (!is_valid) return nothing("the repair gave no valid solid");
  ASSIGN_OR_RETURN(report_.volume_after, nearest_volume(solid_, monitor_));
  return RepairedSolid{std::move(solid_), {}, std::move(report_)};
}

}  // namespace

Result<RepairedSolid> repaired_solid(std::shared_ptr<const TriangleMesh> mesh, const ValidityReport& found,
                                     const RepairOptions& options, const Monitor& monitor) {
  return Repair(std::move(mesh), options, monitor).run(found);
}

}  // namespace algebra3d
