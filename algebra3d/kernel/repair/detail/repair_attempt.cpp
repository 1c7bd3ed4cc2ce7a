#include "algebra3d/kernel/repair/detail/repair_attempt.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/autorefinement/winding_selection.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "algebra3d/kernel/repair/detail/inside_test.h"
#include "algebra3d/kernel/repair/detail/manifold_patches.h"
#include "algebra3d/kernel/repair/detail/shell_filter.h"
#include "algebra3d/kernel/repair/detail/winding_segmentation.h"
#include "algebra3d/kernel/repair/detail/work_limits.h"
#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/disjoint_ids.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The corners of a solid that are doubles.
PointTable corners_of(const TriangleMesh& solid) {
  PointTable table(solid.points().size());
  for (std::size_t i = 0; i < solid.points().size(); ++i)
    if (const PointRef point = solid.points()[i]; point.is_double()) table.intern(point);
  return table;
}

/// Per face that names its set: whether the solid has a corner of a face of the set.
IdVector<FaceId, bool> sets_that_are_left(const TriangleMesh& given, const TriangleMesh& solid,
                                          DisjointIds<FaceId>& sets) {
  const PointTable corners = corners_of(solid);
  const auto is_left_at = [&](const PointRef& corner) { return corners.find(corner.approx) != kNone; };
  IdVector<FaceId, bool> is_left(given.face_count());
  for (const FaceId face : faces(given))
    if (const FaceId set = sets.find(face); !is_left[set])
      is_left[set] = std::ranges::any_of(given.corners(face), is_left_at);
  return is_left;
}

/// Per face that names its patch: whether the patch has an edge that is not of two faces.
IdVector<FaceId, bool> open_patches(const TriangleMesh& mesh, DisjointIds<FaceId>& patches) {
  IdVector<FaceId, bool> is_open(mesh.face_count());
  for (const HalfedgeId h : halfedges(mesh)) {
    const bool ends_patch = mesh.is_boundary(h) || (mesh.is_nonmanifold(h) && mesh.edge_halfedges(h).size() > 2);
    if (ends_patch) is_open[patches.find(TriangleMesh::face(h))] = true;
  }
  return is_open;
}

/// The connected components of the faces as sets, each named by its first face.
DisjointIds<FaceId> component_sets(const FaceComponents& components) {
  DisjointIds<FaceId> sets(components.of_face.size());
  std::vector<FaceId> first(components.count);
  for (std::size_t f = 0; f < components.of_face.size(); ++f) {
    FaceId& known = first[components.of_face[f]];
    if (!known.is_valid()) known = FaceId(f);
    sets.unite(known, FaceId(f));
  }
  return sets;
}

/// Finds lost patches, and reports the closed ones as inner shells, wherever they lie. `given`: the mesh before it was
/// divided, not the file. Called by RepairAttempt, which takes a lost patch beside a hole left open for a body that is
/// not closed. Cost: linear.
LostPatches report_lost_patches(const TriangleMesh& given, const TriangleMesh& solid, RepairReport& report) {
  DisjointIds<FaceId> patches = manifold_patches(given);
  const IdVector<FaceId, bool> is_left = sets_that_are_left(given, solid, patches);
  const IdVector<FaceId, bool> is_open = open_patches(given, patches);
  LostPatches result;
  IdVector<FaceId, bool> is_lost_shell(given.face_count());
  for (const FaceId face : faces(given)) {
    if (patches.find(face) != face || is_left[face]) continue;
    result.is_any = true;
    // Open ones are interfaces, for which the area says more.
    if (is_open[face]) continue;
    report.add(RepairStep::inner_shells, given.corners(face)[0].approx);
    is_lost_shell[face] = true;
  }
  for (const FaceId face : faces(given)) result.is_in_closed_one.push_back(is_lost_shell[patches.find(face)]);
  return result;
}

/// Reports how many bodies became parts of others: closed connected components of `given` (as above) of which a corner
/// is left, minus the components of the solid. `where`: the place to report. Cost: linear.
void report_united_bodies(const TriangleMesh& given, const TriangleMesh& solid, const Vec3& where,
                          RepairReport& report) {
  const FaceComponents components = connected_components(given);
  std::vector<bool> is_open(components.count);
  for (const HalfedgeId h : halfedges(given))
    if (given.is_boundary(h)) is_open[components.of_face[TriangleMesh::face(h).index()]] = true;
  DisjointIds<FaceId> sets = component_sets(components);
  const IdVector<FaceId, bool> is_left = sets_that_are_left(given, solid, sets);
  std::size_t bodies = 0;
  for (const FaceId face : faces(given))
    if (sets.find(face) == face && is_left[face] && !is_open[components.of_face[face.index()]]) ++bodies;
  const std::size_t rest = connected_components(solid).count;
  if (bodies > rest) report.add(RepairStep::united_bodies, where, 0, bodies - rest);
}

/// False for triangles that are divided for the sake of their edges alone.
bool has_manifold_edges(const TriangleMesh& mesh, FaceId face) {
  return std::ranges::all_of(halfedges_of(mesh, face), [&](HalfedgeId h) { return mesh.opposite(h).is_valid(); });
}

Result<bool> is_valid_volume(const TriangleMesh& mesh, const FaceSet& known, const Monitor& monitor) {
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = monitor.cancel(), .known = known};
  A3D_ASSIGN(const ValidityReport found, prove_volume(mesh, options));
  return found.is_valid();
}

/// The corners of a face by their numbers in a table, the smallest first; kNone for points that are not in it.
TriangleMesh::Triangle corners_in(const PointTable& table, const TriangleRef& face) {
  TriangleMesh::Triangle result{};
  std::ranges::transform(face, result.begin(), [&](const PointRef& corner) { return table.find(corner); });
  std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  return result;
}

/// True if two meshes have the same faces with the same orientations, in any order. Exact. Cost: n log n.
bool have_same_faces(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.face_count() != b.face_count()) return false;
  PointTable table(a.vertex_count());
  for (std::size_t v = 0; v < a.vertex_count(); ++v) table.intern(a.points()[v]);
  std::vector<TriangleMesh::Triangle> of_a, of_b;
  for (const FaceId face : faces(a)) of_a.push_back(corners_in(table, a.corners(face)));
  for (const FaceId face : faces(b)) of_b.push_back(corners_in(table, b.corners(face)));
  std::ranges::sort(of_a);
  std::ranges::sort(of_b);
  return of_a == of_b;
}

}  // namespace

bool RepairAttempt::keeps_what_is_enclosed() const {
  return is_proved_ && !has(RepairStep::misconnected_triangles) && !has(RepairStep::dangling_sheets) &&
         !has(RepairStep::open_patches);
}

double RepairAttempt::cost() const {
  const RepairAmounts& amounts = *soup_.report().amounts;
  return amounts.part_of_seen(amounts.left_out) + amounts.part_of_seen(amounts.added);
}

bool RepairAttempt::costs_as_much_as(const RepairAttempt& other) const {
  return soup_.report().largest_move() == other.soup_.report().largest_move() && have_same_faces(solid_, other.solid_);
}

bool RepairAttempt::is_worth_trying(TryIf condition) const {
  constexpr double kWorthATry = 1e-3;
  const bool is_costly = cost() > kWorthATry;
  if (condition == TryIf::costly) return is_costly;
  return left_out_part() > kWorthATry || (soup_.has_covered_nonmanifold_loops() && is_costly);
}

RepairedSolid RepairAttempt::nothing(std::string reason) {
  return {std::nullopt, std::move(reason), std::move(soup_.report()), {}};
}

/// True if the steps before division gave the same triangles, of which the same cells are inside.
bool RepairAttempt::has_triangles_of(const RepairAttempt& other) const {
  const IndexedSoup &own = soup_.soup(), &others = other.soup_.soup();
  return own.triangles.size() == others.triangles.size() && std::ranges::equal(own.triangles, others.triangles) &&
         own.points == others.points &&
         (soup_.strategy().keeps_negative == other.soup_.strategy().keeps_negative || !is_balanced(soup_.mesh()));
}

void RepairAttempt::take_solid_of(const RepairAttempt& other) {
  solid_ = other.solid_;
  met_others_ = other.met_others_;
  is_proved_ = other.is_proved_;
  is_beyond_limit_ = other.is_beyond_limit_;
  if (is_beyond_limit_) reason_ = other.reason_;
  if (!met_others_.empty() && !is_beyond_limit_) report_losses();
}

Status RepairAttempt::make(const ValidityReport& found, std::span<const RepairAttempt* const> earlier) {
  RepairReport& report = soup_.report();
  report.size = soup_.soup().diagonal();
  if (is_balanced(soup_.mesh())) report.volume_before = Amount::nearest(given_->volume().abs());
  soup_.drop_defective(found);
  soup_.stitch();
  A3D_TRY(soup_.orient());
  if (soup_.strategy().closes_bands) {
    A3D_ASSIGN(const bool has_bands, soup_.close_bands());
    if (!has_bands) reason_ = reason_for_nothing();
    if (!has_bands) return {};
  }
  A3D_TRY(soup_.close_holes());
  A3D_TRY(soup_.orient_shells());
  is_made_ = true;
  const auto same = std::ranges::find_if(
      earlier, [&](const RepairAttempt* other) { return other->is_made_ && has_triangles_of(*other); });
  if (same != earlier.end()) {
    take_solid_of(**same);
    return is_beyond_limit_ ? Status() : note_outcome({});
  }
  return note_outcome(make_solid(found.count(Defect::intersecting_triangles) > 0));
}

/// If triangles are known to cross, the proof that they do not is skipped.
Status RepairAttempt::make_solid(bool may_cross) {
  const FaceSet known = recognised_faces(given_->recognise(soup_.mesh()));
  if (!may_cross) {
    A3D_ASSIGN(const bool is_valid, take_if_valid(known));
    if (is_valid) return {};
  }
  A3D_ASSIGN(const ValidParts parts, ValidParts::make(soup_.mesh(), monitor_, known));
  if (may_cross && parts.lone_faces().empty()) {
    A3D_ASSIGN(const bool is_valid, take_if_valid(known));
    if (is_valid) return {};
  }
  return divide(parts);
}

/// Takes the mesh of the soup as it is, if it is a solid.
Result<bool> RepairAttempt::take_if_valid(const FaceSet& known) {
  A3D_ASSIGN(is_proved_, is_valid_volume(soup_.mesh(), known, monitor_));
  if (is_proved_) solid_ = soup_.mesh();
  return is_proved_;
}

/// Divides triangles at one another, and selects what is inside by winding numbers.
Status RepairAttempt::divide(const ValidParts& parts) {
  const TriangleMesh& mesh = soup_.mesh();
  met_others_.assign(mesh.face_count(), false);
  has_divided_ = true;
  for (const FaceId face : parts.lone_faces()) met_others_[face] = has_manifold_edges(mesh, face);
  const WindingRule is_inside = [&](int winding) { return winding > 0 || soup_.strategy().keeps_negative; };
  const ArrangementOptions limits = work_limits(options_);
  auto solid = is_balanced(mesh)
                   ? solid_by_winding(parts, is_inside, monitor_, limits)
                   : solid_by_generalized_winding(soup_.soup(), parts, monitor_, limits, options_.work_limit * 1e6);
  if (!solid) return std::move(solid).error();
  solid_ = *std::move(solid);
  report_losses();
  return {};
}

/// Reports patches and bodies that are no longer there after the division.
void RepairAttempt::report_losses() {
  const TriangleMesh& mesh = soup_.mesh();
  lost_ = report_lost_patches(mesh, solid_, soup_.report());
  report_united_bodies(mesh, solid_, place_of_meeting(), soup_.report());
}

/// The first triangle that was divided, or the first corner.
Vec3 RepairAttempt::place_of_meeting() const {
  for (const FaceId triangle : met_others_.ids())
    if (met_others_[triangle]) return soup_.soup().middle(triangle);
  return met_others_.empty() ? Vec3{} : soup_.mesh().corners(FaceId(0))[0].approx;
}

/// Finds why there is no solid, if there is none.
Status RepairAttempt::note_outcome(Status made) {
  is_beyond_limit_ = !made && made.error().code == ErrorCode::limit_exceeded;
  if (is_beyond_limit_) reason_ = made.error().message + " (option work)";
  if (!made) return is_beyond_limit_ ? Status() : made;
  const bool lacks_what_is_open = has(RepairStep::open_holes) && lost_.is_any;
  const bool is_nothing = solid_.is_empty() && (!soup_.soup().triangles.empty() || !soup_.sheets().empty());
  if (is_nothing || lacks_what_is_open) reason_ = reason_for_nothing();
  return {};
}

std::string RepairAttempt::reason_for_nothing() const {
  if (const RepairEntry* open = soup_.report().find(RepairStep::open_holes))
    return fmt::format("{} {} left open ({})", open->count, open->count == 1 ? "hole was" : "holes were",
                       near_text(open->where, soup_.report().size));
  if (const RepairEntry* patches = soup_.report().find(RepairStep::open_patches))
    return fmt::format("{} ({})",
                       patches->count == 1 ? "the triangles are an open patch" : "the triangles are open patches",
                       near_text(patches->where, soup_.report().size));
  return "the triangles enclose no volume";
}

/// Nothing if the solid is within the limits of what may be left out and added.
std::optional<std::string> RepairAttempt::reason_for_limit() const {
  const RepairAmounts& amounts = *soup_.report().amounts;
  if (left_out_part() > options_.most_dropped) {
    const auto [dropped, most] = percents_above_limit(left_out_part(), options_.most_dropped);
    return fmt::format(
        "the solid would leave out {} of the area seen, up to {} from it; at most {} may be (option dropped)", dropped,
        length_text(amounts.left_out.distance, 3), most);
  }
  if (options_.most_added && amounts.added_part() > *options_.most_added) {
    const auto [added, most] = percents_above_limit(amounts.added_part(), *options_.most_added);
    return fmt::format(
        "{} of the area seen would be added to make a solid, up to {} from the triangles; at most {} may be (option "
        "added)",
        added, length_text(amounts.added.distance, 3), most);
  }
  return std::nullopt;
}

Status RepairAttempt::measure() {
  RepairReport& report = soup_.report();
  if (report.amounts) return {};
  A3D_ASSIGN(MeasuredRepair measured, measure_repair(*given_->mesh(), solid_, given_->recognise(solid_),
                                                     report.largest_move(), report.covers, monitor_.silent()));
  report.amounts = measured.amounts;
  are_covers_there_ = std::move(measured.are_added);
  return {};
}

/// Reports what became of triangles that were divided at one another.
Status RepairAttempt::report_division() {
  if (met_others_.empty()) return {};
  RepairReport& report = soup_.report();
  if (report.has_kept_open_patches) report.forget(RepairStep::open_patches);
  A3D_ASSIGN(const TriangleClasses classes,
             classify_triangles(soup_.mesh(), solid_, report.largest_move(), monitor_.silent()));
  report_divided(classes);
  report_outside(classes);
  return report_turned();
}

void RepairAttempt::report_divided(const TriangleClasses& classes) {
  for (const FaceId f : met_others_.ids())
    if (met_others_[f] && classes.are_divided[f]) soup_.report().add(RepairStep::intersections, soup_.soup().middle(f));
}

/// No more than the file has: triangles may have been split since they were read.
void RepairAttempt::report_outside(const TriangleClasses& classes) {
  std::uint64_t left = soup_.report().amounts->left_out.triangle_count;
  for (const FaceId f : triangles_of_file()) {
    if (!classes.are_outside[f] || lost_.is_in_closed_one[f] || left == 0) continue;
    soup_.report().add(RepairStep::outer_triangles, soup_.soup().middle(f));
    --left;
  }
}

/// Counts the flipped triangles again, with those that have the inside in front of them and the outside behind: the
/// boundary of what has a negative winding number has its faces the other way.
Status RepairAttempt::report_turned() {
  if (is_balanced(soup_.mesh()) && !soup_.strategy().keeps_negative) return {};
  const IndexedSoup& soup = soup_.soup();
  const std::vector<FaceId> triangles = triangles_of_file();
  std::vector<Vec3> places;  // for each triangle one in front of its middle, and one behind
  for (const FaceId f : triangles) {
    const Vec3 normal = cross(soup.corner(f, 1) - soup.corner(f, 0), soup.corner(f, 2) - soup.corner(f, 0));
    const double size = length(normal);
    const Vec3 step = size > 0 ? (1e-6 / std::sqrt(size)) * normal : Vec3{};
    places.push_back(soup.middle(f) + step);
    places.push_back(soup.middle(f) - step);
  }
  A3D_ASSIGN(const std::vector<bool> are_inside, InsideTest(solid_).are_inside(places, monitor_.silent()));
  // Where whole shells were turned, their triangles are not counted.
  const bool has_turned_shells = has(RepairStep::flipped_shells);
  const std::vector<bool> were_flipped =
      has_turned_shells ? std::vector<bool>(triangles.size()) : are_flipped_so_far(triangles);
  if (!has_turned_shells) soup_.report().forget(RepairStep::flipped_triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if ((are_inside[2 * i] && !are_inside[2 * i + 1]) != were_flipped[i])
      soup_.report().add(RepairStep::flipped_triangles, soup.middle(triangles[i]));
  return {};
}

/// Whether the soup has these triangles the other way than the file; false for those that the file does not have.
std::vector<bool> RepairAttempt::are_flipped_so_far(const std::vector<FaceId>& triangles) const {
  const auto as_listed = [](const Triangle3& corners) {
    Triangle3 result = corners;
    std::rotate(result.begin(), std::ranges::min_element(result), result.end());
    return result;
  };
  std::vector<Triangle3> given;
  const TriangleMesh& file = *given_->mesh();
  for (const FaceId f : faces(file)) {
    const TriangleRef corners = file.corners(f);
    given.push_back(as_listed({corners[0].approx, corners[1].approx, corners[2].approx}));
  }
  std::ranges::sort(given);
  std::vector<bool> result;
  for (const FaceId f : triangles) {
    const Triangle3 here = as_listed({soup_.soup().corner(f, 0), soup_.soup().corner(f, 1), soup_.soup().corner(f, 2)});
    const Triangle3 back{here[0], here[2], here[1]};
    result.push_back(!std::ranges::binary_search(given, here) && std::ranges::binary_search(given, back));
  }
  return result;
}

/// The triangles of the soup that are not those of covers.
std::vector<FaceId> RepairAttempt::triangles_of_file() const {
  const std::vector<Triangle3> covers = soup_.report().cover_triangles();
  const IndexedSoup& soup = soup_.soup();
  std::vector<FaceId> result;
  for (const FaceId f : soup.triangles.ids()) {
    Triangle3 key{soup.corner(f, 0), soup.corner(f, 1), soup.corner(f, 2)};
    std::ranges::sort(key);
    if (!std::ranges::binary_search(covers, key)) result.push_back(f);
  }
  return result;
}

/// Leaves out shells that the options do not want.
Status RepairAttempt::filter() {
  A3D_ASSIGN(const TriangleMesh kept, filter_shells(solid_, options_, soup_.report(), monitor_));
  const bool is_all_kept = kept.face_count() == solid_.face_count();
  is_proved_ = is_proved_ && is_all_kept;
  solid_ = in_spatial_order(kept);
  if (is_all_kept) return {};
  soup_.report().amounts.reset();
  return measure();
}

/// Reports holes that are closed in the solid, and triangles inside it that no earlier step has counted.
Status RepairAttempt::complete_report() {
  RepairReport& report = soup_.report();
  report.drop_missing_covers(are_covers_there_);
  const SurfaceAmount& inside = report.amounts->inside;
  if (inside.triangle_count == 0) return {};
  A3D_ASSIGN(const std::vector<bool> are_inside,
             InsideTest(solid_).are_inside(soup_.dropped_middles(), monitor_.silent()));
  const auto counted = static_cast<std::uint64_t>(std::ranges::count(are_inside, true));
  if (inside.triangle_count > counted)
    report.add(RepairStep::inner_triangles, inside.where, 0, inside.triangle_count - counted);
  return {};
}

Result<bool> RepairAttempt::is_proved(const FaceSet& known) const {
  if (is_proved_) return true;
  return is_valid_volume(solid_, known, monitor_);
}

Result<RepairedSolid> RepairAttempt::finish() && {
  if (reason_) return nothing(*reason_);
  A3D_TRY(measure());
  if (const auto reason = reason_for_limit()) return nothing(*reason);
  A3D_TRY(report_division());
  A3D_TRY(filter());
  A3D_TRY(complete_report());
  const FaceMatches recognised = given_->recognise(solid_);
  A3D_ASSIGN(const bool is_valid, is_proved(recognised_faces(recognised)));
  if (!is_valid) return nothing("the repair gave no valid solid");
  A3D_ASSIGN(const Rational volume, given_->volume_of(solid_, recognised, monitor_.cancel()));
  soup_.report().volume_after = Amount::nearest(volume);
  return RepairedSolid{std::move(solid_), {}, std::move(soup_.report()), soup_.strategy().name};
}

}  // namespace algebra3d
