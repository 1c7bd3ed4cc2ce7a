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
#include "algebra3d/repair/bands.h"
#include "algebra3d/repair/convex_polygon.h"
#include "algebra3d/repair/cracks.h"
#include "algebra3d/repair/degenerate_facets.h"
#include "algebra3d/repair/enclosure.h"
#include "algebra3d/repair/facet_orientation.h"
#include "algebra3d/repair/facet_parts.h"
#include "algebra3d/repair/fins.h"
#include "algebra3d/repair/holes.h"
#include "algebra3d/repair/kept_shells.h"
#include "algebra3d/repair/misfits.h"
#include "algebra3d/repair/point_table.h"
#include "algebra3d/repair/repair_amounts.h"
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
  bool closes_bands = false;      ///< between boundaries that run close to each other; else there is no solid
  bool covers_walls = false;      ///< that end at edges of more than two facets, so that winding numbers are whole
  bool takes_shortcuts = false;   ///< covers end at edges that lack nothing, where that is shorter
  bool fills_inside_out = false;  ///< places about which the winding number is negative belong to the solid
};

/// What is preferred for its cost costs less than this part of the other one.
constexpr double kCheaper = 0.95;

/// For facets of which the usual way leaves something out, or adds much.
constexpr Approach kWithBands{.closes_bands = true};

/// For facets of which the usual way leaves something out, or covers long rims.
constexpr std::array<Approach, 3> kCheapApproaches{{
    {.drops_open = false},
    {.drops_open = false, .takes_shortcuts = true},
    {.drops_open = false, .covers_walls = true, .fills_inside_out = true},
}};

/// In the order in which they are tried.
constexpr std::array<Approach, 7> kApproaches{{
    {},
    {.fills_inside_out = true},
    {.joins_cracks = false},
    {.drops_open = false},
    {.drops_open = false, .covers_walls = true, .fills_inside_out = true},
    {.joins_cracks = false, .drops_open = false, .closes_holes = false},
    kWithBands,
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
    const auto has_none = [&](RepairStep step) { return report_.find(step) == nullptr; };
    return is_proved_ && has_none(RepairStep::misfits) && has_none(RepairStep::fins) && has_none(RepairStep::sheets);
  }
  /// Not if it is out of reach, or open because the options say so.
  bool may_be_done_otherwise() const { return !is_beyond_limit_ && report_.find(RepairStep::open_holes) == nullptr; }
  Result<RepairedSolid> finish() &&;
  /// Says what the solid leaves out and adds; once.
  Status measure();
  /// The area that was left out and that which was added, as a part of the area seen.
  double cost() const {
    const RepairAmounts& amounts = *report_.amounts;
    return amounts.part_of_seen(amounts.dropped) + amounts.part_of_seen(amounts.added);
  }
  bool has_covered_rims() const { return has_covered_rims_; }
  bool has_replaced_misfits() const { return report_.find(RepairStep::misfits) != nullptr; }
  double dropped_part() const { return report_.amounts->dropped_part(); }
  RepairedSolid nothing(std::string reason) { return {std::nullopt, std::move(reason), std::move(report_)}; }

 private:
  /// Until the facets change.
  const TriangleMesh& mesh() const { return *facets_.mesh(); }
  void drop_facets(bool has_degenerate, bool has_duplicates);
  void drop_what_became_flat();
  void mend_boundaries();
  void orient();
  /// False if there are none.
  Result<bool> close_bands();
  Status close_holes();
  /// Whoever knows that facets cross spares the attempt to prove that they do not.
  Status make_solid(bool may_cross);
  Result<bool> take_if_valid(const FaceSet& known);
  Status divide(const ValidParts& parts);
  std::vector<bool> are_left(arrangement::DisjointSets& parts) const;
  void report_lost_shells();
  void report_united_bodies();
  Status report_division();
  std::string reason_for_limit() const;
  Result<bool> is_proved(const FaceSet& known);
  std::string reason_for_nothing() const;

  const KnownFacets* given_;
  Approach approach_;
  RepairOptions options_;
  Monitor monitor_;
  FacetList facets_;
  std::shared_ptr<const TriangleMesh> without_flat_;  // the facets when those were dropped last
  TriangleMesh solid_;
  std::vector<bool> met_others_;  // per facet: divided at others; empty if none was
  std::vector<bool> is_in_lost_shell_;
  bool is_proved_ = false;
  bool is_beyond_limit_ = false;
  bool has_covered_rims_ = false;
  bool has_lost_parts_ = false;
  std::optional<std::string> reason_;  // why there is no solid
  RepairReport report_;
  std::vector<bool> are_holes_closed_;  // of the covers in the report, once that is measured
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
  if (!is_double && is_balanced(mesh()) && has_open_edges(*rest.mesh())) {
    // Those that balance each other change no winding number.
    drop_opposed_facets(facets_, report_);
    return;
  }
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
  if (mesh().nonmanifold_edge_count() > 0) orient_facets(facets_, report_);
  if (approach_.drops_open && has_boundary(mesh())) drop_misfits(facets_, report_);
  if (approach_.drops_open && has_boundary(mesh()) && mesh().nonmanifold_edge_count() > 0) drop_fins(facets_, report_);
}

Result<bool> Repair::close_bands() {
  const double largest = options_.largest_hole.value_or(std::numeric_limits<double>::infinity());
  ASSIGN_OR_RETURN(const bool has_some, algebra3d::close_bands(facets_, largest, report_, monitor_));
  if (has_some) drop_what_became_flat();
  return has_some;
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
    const std::size_t hole_count = report_.covers.size();
    RETURN_IF_ERROR(close_rims(facets_, {largest, false, approach_.takes_shortcuts}, report_, monitor_));
    has_covered_rims_ = has_covered_rims_ || report_.covers.size() > hole_count;
    if (facets_.triangles.size() == facet_count || report_.find(RepairStep::open_holes) != nullptr) break;
    drop_what_became_flat();
  }
  if (approach_.covers_walls)
    RETURN_IF_ERROR(close_rims(facets_, {largest, true, approach_.takes_shortcuts}, report_, monitor_));
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
  met_others_.assign(facets_.triangles.size(), false);
  for (const FaceId face : parts.lone_faces()) met_others_[face.index()] = has_manifold_edges(mesh(), face);
  const auto is_inside = [&](int winding) { return winding > 0 || approach_.fills_inside_out; };
  auto solid = is_closed ? winding_solid(parts, is_inside, monitor_, work_limits(options_))
                         : tolerant_solid(facets_, parts, monitor_, work_limits(options_), options_.work_limit * 1e6);
  if (!solid) return std::move(solid).error();
  solid_ = *std::move(solid);
  report_lost_shells();
  report_united_bodies();
  return {};
}

/// Per face of the mesh that is the first of its part: whether the solid has a corner of the part.
std::vector<bool> Repair::are_left(arrangement::DisjointSets& parts) const {
  PointTable left(2 * solid_.points().size());
  for (std::size_t i = 0; i < solid_.points().size(); ++i)
    if (const Vec3& point = solid_.points().approx()[i]; solid_.points()[i].is_double())
      left.number_of(point, hash_of(point));
  const TriangleMesh& given = mesh();
  std::vector<bool> is_left(given.face_count());
  const auto is_left_at = [&](const PointRef& corner) {
    return left.find(corner.approx, hash_of(corner.approx)) != PointTable::kNone;
  };
  for (std::uint32_t f = 0; f < given.face_count(); ++f)
    if (const std::uint32_t part = parts.find(f); !is_left[part])
      is_left[part] = std::ranges::any_of(given.corners(FaceId(f)), is_left_at);
  return is_left;
}

/// Reports components, connected across edges of two facets, of which no corner is left.
void Repair::report_lost_shells() {
  const TriangleMesh& given = mesh();
  arrangement::DisjointSets parts = parts_across_simple_edges(given);
  const std::vector<bool> is_left = are_left(parts);
  std::vector<bool> is_open(given.face_count());
  for (std::uint32_t h = 0; h < given.halfedge_count(); ++h) {
    const HalfedgeId halfedge(h);
    const bool ends =
        given.is_boundary(halfedge) || (given.is_nonmanifold(halfedge) && given.edge_halfedges(halfedge).size() > 2);
    if (ends) is_open[parts.find(h / 3)] = true;
  }
  std::vector<bool> is_lost_shell(given.face_count());
  for (std::uint32_t f = 0; f < given.face_count(); ++f) {
    if (parts.find(f) != f || is_left[f]) continue;
    has_lost_parts_ = true;
    // Others are walls, of which the area tells more.
    if (is_open[f]) continue;
    report_.add(RepairStep::inner_shells, given.corners(FaceId(f))[0].approx);
    is_lost_shell[f] = true;
  }
  is_in_lost_shell_.clear();
  for (std::uint32_t f = 0; f < given.face_count(); ++f) is_in_lost_shell_.push_back(is_lost_shell[parts.find(f)]);
}

/// Closed parts of which something is left, less the parts of the solid.
void Repair::report_united_bodies() {
  const TriangleMesh& given = mesh();
  const FaceComponents components = connected_components(given);
  std::vector<bool> is_open(components.count);
  for (std::uint32_t h = 0; h < given.halfedge_count(); ++h)
    if (given.is_boundary(HalfedgeId(h))) is_open[components.of_face[h / 3]] = true;
  arrangement::DisjointSets parts(given.face_count());
  std::vector<std::uint32_t> first(components.count, PointTable::kNone);
  for (std::uint32_t f = 0; f < given.face_count(); ++f) {
    std::uint32_t& known = first[components.of_face[f]];
    if (known == PointTable::kNone) known = f;
    parts.unite(known, f);
  }
  const std::vector<bool> is_left = are_left(parts);
  std::size_t bodies = 0;
  for (std::size_t c = 0; c < components.count; ++c) bodies += !is_open[c] && is_left[parts.find(first[c])] ? 1 : 0;
  const std::size_t rest = connected_components(solid_).count;
  if (bodies <= rest) return;
  const auto meeting = std::ranges::find(met_others_, true) - met_others_.begin();
  const bool is_known = meeting < std::ssize(met_others_);
  report_.add(RepairStep::united_bodies,
              is_known ? facets_.middle(static_cast<std::size_t>(meeting)) : given.corners(FaceId(0))[0].approx, 0,
              bodies - rest);
}

Status Repair::measure() {
  if (report_.amounts) return {};
  ASSIGN_OR_RETURN(MeasuredRepair measured, measure_repair(*given_->mesh(), solid_, given_->recognise(solid_),
                                                           report_.largest_move(), report_.covers, monitor_.silent()));
  report_.amounts = measured.amounts;
  are_holes_closed_ = std::move(measured.are_added);
  return {};
}

/// Reports what became of facets that were divided at one another.
Status Repair::report_division() {
  if (met_others_.empty()) return {};
  if (report_.has_kept_sheets) report_.forget(RepairStep::sheets);
  ASSIGN_OR_RETURN(const FacetFates fates, facet_fates(mesh(), solid_, report_.largest_move(), monitor_.silent()));
  const std::vector<Triangle3> covers = report_.cover_triangles();
  // Facets may have been divided at vertices since they were read.
  std::uint64_t outside_left = report_.amounts->dropped.facet_count;
  for (std::size_t f = 0; f < facets_.triangles.size(); ++f) {
    if (met_others_[f] && fates.are_divided[f]) report_.add(RepairStep::intersections, facets_.middle(f));
    if (!fates.are_outside[f] || is_in_lost_shell_[f] || outside_left == 0) continue;
    Triangle3 key{facets_.corner(f, 0), facets_.corner(f, 1), facets_.corner(f, 2)};
    std::ranges::sort(key);
    if (std::ranges::binary_search(covers, key)) continue;
    report_.add(RepairStep::outer_facets, facets_.middle(f));
    --outside_left;
  }
  return {};
}

std::string Repair::reason_for_limit() const {
  const RepairAmounts& amounts = *report_.amounts;
  const auto [dropped, most] = percents_above_limit(amounts.dropped_part(), options_.most_dropped);
  return fmt::format(
      "the solid would leave out {} of the area seen, up to {} from it; at most {} may be (option "
      "dropped)",
      dropped, length_text(amounts.dropped.distance, 3), most);
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
  report_.size = diagonal(facets_);
  if (is_balanced(mesh())) report_.volume_before = Amount::nearest(given_->volume().abs());
  drop_facets(found.count(Defect::degenerate_triangle) > 0, found.count(Defect::duplicate_triangle) > 0);
  without_flat_ = facets_.mesh();
  mend_boundaries();
  orient();
  if (approach_.closes_bands) {
    ASSIGN_OR_RETURN(const bool has_bands, close_bands());
    if (!has_bands) reason_ = reason_for_nothing();
    if (!has_bands) return {};
  }
  RETURN_IF_ERROR(close_holes());
  Status made = make_solid(found.count(Defect::intersecting_triangles) > 0);
  is_beyond_limit_ = !made && made.error().code == ErrorCode::limit_exceeded;
  if (is_beyond_limit_) reason_ = made.error().message;
  if (!made && !is_beyond_limit_) return made;
  const bool lacks_what_is_open = report_.find(RepairStep::open_holes) != nullptr && has_lost_parts_;
  const bool is_nothing = solid_.is_empty() && !facets_.triangles.empty();
  if (!is_beyond_limit_ && (is_nothing || lacks_what_is_open)) reason_ = reason_for_nothing();
  return {};
}

Result<RepairedSolid> Repair::finish() && {
  if (reason_) return nothing(*reason_);
  RETURN_IF_ERROR(measure());
  if (dropped_part() > options_.most_dropped) return nothing(reason_for_limit());
  RETURN_IF_ERROR(report_division());
  ASSIGN_OR_RETURN(const TriangleMesh kept, kept_shells(solid_, options_, report_, monitor_));
  const bool is_all_kept = kept.face_count() == solid_.face_count();
  is_proved_ = is_proved_ && is_all_kept;
  solid_ = in_spatial_order(kept);
  if (!is_all_kept) {
    report_.amounts.reset();
    RETURN_IF_ERROR(measure());
  }
  report_.keep_holes(are_holes_closed_);
  if (const SurfaceAmount& inside = report_.amounts->inside; inside.facet_count > 0)
    report_.add(RepairStep::inner_facets, inside.where, 0, inside.facet_count);
  const std::vector<std::uint32_t> recognised = given_->recognise(solid_);
  ASSIGN_OR_RETURN(const bool is_valid, is_proved(recognised_faces(recognised)));
  if (!is_valid) return nothing("the repair gave no valid solid");
  ASSIGN_OR_RETURN(const Rational volume, given_->volume_of(solid_, recognised, monitor_.cancel()));
  report_.volume_after = Amount::nearest(volume);
  return RepairedSolid{std::move(solid_), {}, std::move(report_)};
}

/// The search for the repair of the given facets that suits them, one way after the other.
class RepairSearch {
 public:
  RepairSearch(const KnownFacets& given, const ValidityReport& found, const RepairOptions& options,
               const Monitor& monitor)
      : given_(given), found_(found), options_(options), monitor_(monitor) {}

  Result<RepairedSolid> run();

 private:
  Result<Repair> made(const Approach& approach) const;
  Agreement agreement(const Repair& repair);
  Result<RepairedSolid> cheapest(Repair usual);
  Result<RepairedSolid> finish(Repair repair);
  /// Puts what another approach gives in place of the repair, if that is cheaper.
  Status try_for_cost(const Approach& approach, Repair& repair);

  const KnownFacets& given_;
  const ValidityReport& found_;
  const RepairOptions& options_;
  const Monitor& monitor_;
  std::optional<Enclosure> enclosure_;
  /// A repair that did not agree so well, since facets with wrong corners were replaced that what the facets enclose
  /// was estimated with.
  std::optional<Repair> without_misfits_;
};

Result<Repair> RepairSearch::made(const Approach& approach) const {
  Repair repair(given_, approach, options_, monitor_);
  RETURN_IF_ERROR(repair.make(found_));
  return repair;
}

Agreement RepairSearch::agreement(const Repair& repair) {
  if (!enclosure_) enclosure_.emplace(*given_.mesh());
  return enclosure_->compare(repair.solid());
}

/// The repair, or that without misfits if it is cheaper.
Result<RepairedSolid> RepairSearch::finish(Repair repair) {
  if (!without_misfits_ || !repair.has_solid()) return std::move(repair).finish();
  RETURN_IF_ERROR(repair.measure());
  RETURN_IF_ERROR(without_misfits_->measure());
  if (without_misfits_->cost() < kCheaper * repair.cost()) repair = *std::move(without_misfits_);
  return std::move(repair).finish();
}

Status RepairSearch::try_for_cost(const Approach& approach, Repair& repair) {
  ASSIGN_OR_RETURN(Repair other, made(approach));
  if (!other.has_solid() || agreement(other).is_doubtful()) return {};
  RETURN_IF_ERROR(other.measure());
  if (other.cost() < kCheaper * repair.cost()) repair = std::move(other);
  return {};
}

/// The usual repair, or a cheaper one: facets that the usual way leaves out may be a cap that lacks a narrow strip. If
/// closing it adds less than leaving it out loses, it is closed.
Result<RepairedSolid> RepairSearch::cheapest(Repair usual) {
  constexpr double kWorthATry = 1e-3;
  if (!usual.has_solid() || !usual.may_be_done_otherwise()) return finish(std::move(usual));
  RETURN_IF_ERROR(usual.measure());
  if (usual.cost() > kWorthATry) RETURN_IF_ERROR(try_for_cost(kWithBands, usual));
  const bool is_worth_it = usual.dropped_part() > kWorthATry || (usual.has_covered_rims() && usual.cost() > kWorthATry);
  if (!is_worth_it) return finish(std::move(usual));
  for (const Approach& approach : kCheapApproaches) RETURN_IF_ERROR(try_for_cost(approach, usual));
  return finish(std::move(usual));
}

Result<RepairedSolid> RepairSearch::run() {
  std::optional<Repair> usual, fair;
  for (const Approach& approach : kApproaches) {
    ASSIGN_OR_RETURN(Repair repair, made(approach));
    if (!usual && repair.keeps_all_facets()) return cheapest(std::move(repair));
    const Agreement found = agreement(repair);
    if (!found.is_doubtful() && (!usual || repair.has_solid())) return cheapest(std::move(repair));
    const bool is_fair = !found.is_wrong() && repair.has_solid();
    if (!fair && is_fair) fair = repair;
    if (!without_misfits_ && is_fair && repair.has_replaced_misfits()) without_misfits_ = repair;
    if (!usual) usual = std::move(repair);
    if (!usual->may_be_done_otherwise()) break;
  }
  if (fair) return std::move(*fair).finish();
  if (usual->has_solid())
    return usual->nothing("every solid that was made of the facets lacks most of what they enclose, or adds as much");
  return std::move(*usual).finish();
}

}  // namespace

Result<RepairedSolid> repaired_solid(const KnownFacets& given, const ValidityReport& found,
                                     const RepairOptions& options, const Monitor& monitor) {
  return RepairSearch(given, found, options, monitor).run();
}

}  // namespace algebra3d
