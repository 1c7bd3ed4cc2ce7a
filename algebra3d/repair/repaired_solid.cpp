#include "algebra3d/repair/repaired_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/cracks.h"
#include "algebra3d/repair/degenerate_facets.h"
#include "algebra3d/repair/enclosure.h"
#include "algebra3d/repair/facet_orientation.h"
#include "algebra3d/repair/facet_parts.h"
#include "algebra3d/repair/fins.h"
#include "algebra3d/repair/holes.h"
#include "algebra3d/repair/kept_shells.h"
#include "algebra3d/repair/point_table.h"
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

/// How far apart equal corners may be where somebody rounded them: a few floats, or a little of the size of the file,
/// its diagonal.
double noise(const FacetList& facets, double size) {
  constexpr double kNoisePerDiagonal = 1e-6;
  constexpr double kFloats = 4 * 0x1p-23;
  double farthest = 0;
  for (const TriangleMesh::Triangle& triangle : facets.triangles)
    for (const std::uint32_t corner : triangle)
      for (std::size_t axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::abs(facets.points[corner][axis]));
  return std::max(kNoisePerDiagonal * size, kFloats * farthest);
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

/// How facets are taken to be meant.
struct Approach {
  bool joins_cracks = true;       ///< else steps 3 and 4 divide edges at most
  bool drops_open = true;         ///< fins, and sheets beside others
  bool closes_holes = true;       ///< else winding numbers alone tell what is inside
  bool covers_walls = false;      ///< that end at edges of more than two facets, so that winding numbers are whole
  bool fills_inside_out = false;  ///< places about which the winding number is negative belong to the solid
};

/// In the order in which they are tried.
constexpr std::array<Approach, 6> kApproaches{{
    {},
    {.fills_inside_out = true},
    {.joins_cracks = false},
    {.drops_open = false},
    {.drops_open = false, .covers_walls = true, .fills_inside_out = true},
    {.joins_cracks = false, .drops_open = false, .closes_holes = false},
}};

class Repair {
 public:
  /// `given` must outlive this.
  Repair(const KnownFacets& given, const Approach& approach, const RepairOptions& options, const Monitor& monitor)
      : given_(&given), approach_(approach), options_(options), monitor_(monitor), facets_(given.mesh()) {}

  /// All steps but the last; tells nothing of the solid if that is not to be had.
  Status make(const ValidityReport& found);
  bool has_solid() const { return !reason_; }
  const TriangleMesh& solid() const { return solid_; }
  /// Then it encloses what they do; only small ones that became flat are left out, and copies of others.
  bool keeps_all_facets() const {
    return is_proved_ && report_.find(RepairStep::fins) == nullptr && report_.find(RepairStep::sheets) == nullptr;
  }
  /// Not if it is out of reach, or open because the options say so.
  bool may_be_done_otherwise() const { return !is_beyond_limit_ && report_.find(RepairStep::open_holes) == nullptr; }
  Result<RepairedSolid> finish() &&;
  RepairedSolid nothing(std::string reason) { return {std::nullopt, std::move(reason), std::move(report_)}; }

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
  Result<bool> take_if_valid(const FaceSet& known);
  Status divide(const ValidParts& parts);
  void report_lost_shells();
  Result<bool> is_proved(const FaceSet& known);
  std::string reason_for_nothing() const;

  const KnownFacets* given_;
  Approach approach_;
  RepairOptions options_;
  Monitor monitor_;
  FacetList facets_;
  std::shared_ptr<const TriangleMesh> without_flat_;  // the facets when those were dropped last
  TriangleMesh solid_;
  bool is_proved_ = false;
  bool is_beyond_limit_ = false;
  std::optional<std::string> reason_;  // why there is no solid
  RepairReport report_;
};

void Repair::drop_facets(bool has_degenerate, bool has_duplicates) {
  if (has_degenerate) drop_degenerate_facets(facets_, report_);
  if (!has_duplicates || !has_duplicate_facets(mesh())) return;
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
  if (facets_.mesh() == without_flat_) return;
  RepairReport given = report_;
  drop_facets(true, true);
  report_ = std::move(given);
  without_flat_ = facets_.mesh();
}

void Repair::mend_boundaries() {
  if (!has_boundary(mesh())) return;
  const double size = diagonal(facets_);
  const double tolerance = approach_.joins_cracks ? options_.crack_tolerance.value_or(kCrackPerDiagonal * size) : 0;
  join_equal_corners(facets_, std::min(tolerance, noise(facets_, size)), report_);
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
  if (approach_.drops_open && has_boundary(mesh()) && mesh().nonmanifold_edge_count() > 0) drop_fins(facets_, report_);
}

Status Repair::close_holes() {
  if (!approach_.closes_holes) return {};
  // What covers a hole may be flat in part, and leave smaller ones where that is dropped.
  constexpr int kMostRounds = 4;
  const double largest = options_.largest_hole.value_or(std::numeric_limits<double>::infinity());
  for (int round = 0; round < kMostRounds && has_boundary(mesh()); ++round) {
    if (round > 0) divide_edges(facets_, report_);
    const std::size_t facet_count = facets_.triangles.size();
    RETURN_IF_ERROR(algebra3d::close_holes(facets_, {largest, approach_.drops_open}, report_, monitor_));
    RETURN_IF_ERROR(close_rims(facets_, {largest, false}, report_, monitor_));
    if (facets_.triangles.size() == facet_count || report_.find(RepairStep::open_holes) != nullptr) break;
    drop_what_became_flat();
  }
  if (approach_.covers_walls) RETURN_IF_ERROR(close_rims(facets_, {largest, true}, report_, monitor_));
  drop_what_became_flat();
  return {};
}

/// As they are, they may be a solid.
Result<bool> Repair::take_if_valid(const FaceSet& known) {
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = monitor_.cancel(), .known = known};
  ASSIGN_OR_RETURN(const ValidityReport found, prove_volume(mesh(), options));
  is_proved_ = found.is_valid();
  if (is_proved_) solid_ = mesh();
  return is_proved_;
}

Status Repair::make_solid(bool may_cross) {
  RETURN_IF_ERROR(orient_shells(facets_, report_, monitor_));
  const FaceSet known = recognised_faces(given_->recognise(mesh()));
  if (!may_cross) {
    ASSIGN_OR_RETURN(const bool is_valid, take_if_valid(known));
    if (is_valid) return {};
  }
  ASSIGN_OR_RETURN(const ValidParts parts, ValidParts::make(mesh(), monitor_, known));
  if (may_cross && parts.lone_faces().empty()) {
    ASSIGN_OR_RETURN(const bool is_valid, take_if_valid(known));
    if (is_valid) return {};
  }
  return divide(parts);
}

Status Repair::divide(const ValidParts& parts) {
  const bool is_closed = is_balanced(mesh());
  for (const FaceId face : parts.lone_faces())
    if (has_manifold_edges(mesh(), face)) report_.add(RepairStep::intersections, facets_.middle(face.index()));
  const auto is_inside = [&](int winding) { return winding > 0 || approach_.fills_inside_out; };
  auto solid = is_closed ? winding_solid(parts, is_inside, monitor_, work_limits(options_))
                         : tolerant_solid(facets_, parts, monitor_, work_limits(options_), options_.work_limit * 1e6);
  if (!solid) return std::move(solid).error();
  solid_ = *std::move(solid);
  report_lost_shells();
  return {};
}

/// What hangs together across edges of two facets, and of which no corner is left.
void Repair::report_lost_shells() {
  PointTable left(2 * solid_.points().size());
  for (std::size_t i = 0; i < solid_.points().size(); ++i)
    if (const Vec3& point = solid_.points().approx()[i]; solid_.points()[i].is_double())
      left.number_of(point, hash_of(point));
  const TriangleMesh& given = mesh();
  arrangement::DisjointSets parts = parts_across_simple_edges(given);
  std::vector<bool> is_left(given.face_count());  // of each part, at its number
  const auto is_left_at = [&](const PointRef& corner) {
    return left.find(corner.approx, hash_of(corner.approx)) != PointTable::kNone;
  };
  for (std::uint32_t f = 0; f < given.face_count(); ++f)
    if (const std::uint32_t part = parts.find(f); !is_left[part])
      is_left[part] = std::ranges::any_of(given.corners(FaceId(f)), is_left_at);
  for (std::uint32_t f = 0; f < given.face_count(); ++f)
    if (parts.find(f) == f && !is_left[f]) report_.add(RepairStep::inner_shells, given.corners(FaceId(f))[0].approx);
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

Result<bool> Repair::is_proved(const FaceSet& known) {
  if (is_proved_) return true;
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = monitor_.cancel(), .known = known};
  ASSIGN_OR_RETURN(const ValidityReport found, prove_volume(solid_, options));
  return found.is_valid();
}

Status Repair::make(const ValidityReport& found) {
  if (is_balanced(mesh())) report_.volume_before = given_->volume().abs().nearest_double();
  drop_facets(found.count(Defect::degenerate_triangle) > 0, found.count(Defect::duplicate_triangle) > 0);
  without_flat_ = facets_.mesh();
  mend_boundaries();
  orient();
  RETURN_IF_ERROR(close_holes());
  Status made = make_solid(found.count(Defect::intersecting_triangles) > 0);
  is_beyond_limit_ = !made && made.error().code == ErrorCode::limit_exceeded;
  if (is_beyond_limit_) reason_ = made.error().message;
  if (!made && !is_beyond_limit_) return made;
  const bool lacks_what_is_open =
      report_.find(RepairStep::open_holes) != nullptr && report_.find(RepairStep::inner_shells) != nullptr;
  const bool is_nothing = solid_.is_empty() && !facets_.triangles.empty();
  if (!is_beyond_limit_ && (is_nothing || lacks_what_is_open)) reason_ = reason_for_nothing();
  return {};
}

Result<RepairedSolid> Repair::finish() && {
  if (reason_) return nothing(*reason_);
  ASSIGN_OR_RETURN(const TriangleMesh kept, kept_shells(solid_, options_, report_, monitor_));
  is_proved_ = is_proved_ && kept.face_count() == solid_.face_count();
  solid_ = in_spatial_order(kept);
  const std::vector<std::uint32_t> recognised = given_->recognise(solid_);
  ASSIGN_OR_RETURN(const bool is_valid, is_proved(recognised_faces(recognised)));
  if (!is_valid) return nothing("the repair gave no valid solid");
  ASSIGN_OR_RETURN(const Rational volume, given_->volume_of(solid_, recognised, monitor_.cancel()));
  report_.volume_after = volume.nearest_double();
  return RepairedSolid{std::move(solid_), {}, std::move(report_)};
}

}  // namespace

Result<RepairedSolid> repaired_solid(const KnownFacets& given, const ValidityReport& found,
                                     const RepairOptions& options, const Monitor& monitor) {
  std::optional<Enclosure> enclosure;
  std::optional<Repair> usual, fair;
  for (const Approach& approach : kApproaches) {
    Repair repair(given, approach, options, monitor);
    RETURN_IF_ERROR(repair.make(found));
    if (!usual && repair.keeps_all_facets()) return std::move(repair).finish();
    if (!enclosure) enclosure.emplace(*given.mesh());
    const Agreement agreement = enclosure->compare(repair.solid());
    if (!agreement.is_doubtful() && (!usual || repair.has_solid())) return std::move(repair).finish();
    if (!fair && !agreement.is_wrong() && repair.has_solid()) fair = repair;
    if (!usual) usual = std::move(repair);
    if (!usual->may_be_done_otherwise()) break;
  }
  if (fair) return std::move(*fair).finish();
  if (usual->has_solid())
    return usual->nothing("every solid that was made of the facets lacks most of what they enclose, or adds as much");
  return std::move(*usual).finish();
}

}  // namespace algebra3d
