#include "algebra3d/kernel/rounding/detail/rounding_ladder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/rounding/detail/narrow_gaps.h"
#include "algebra3d/kernel/rounding/detail/rounding_rungs.h"
#include "algebra3d/kernel/rounding/detail/simpler_form.h"
#include "algebra3d/kernel/rounding/detail/thickening.h"
#include "algebra3d/kernel/rounding/detail/triangle_stars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// A result no farther away, in spacings, is not looked for any nearer.
constexpr double kNearEnough = 64;

/// A job on its way up, with what several rungs need: each is made when it is first asked for.
class Climb {
 public:
  explicit Climb(RoundingJob& rounding) : job(rounding) {}

  /// The snap rounded mesh.
  Result<const RoundingCandidate*> snapped() {
    if (!snapped_) {
      A3D_ASSIGN(snapped_, snap_rounded(job.mesh(), job.vertices(), job.cancel()));
    }
    return &*snapped_;
  }
  /// The vertices of which a triangle crosses others after snap rounding.
  Result<const std::vector<bool>*> crowded() {
    if (!crowded_) {
      A3D_ASSIGN(const RoundingCandidate* candidate, snapped());
      A3D_ASSIGN(crowded_, crowded_vertices(job, candidate->mesh));
    }
    return &*crowded_;
  }
  /// True if most vertices are crowded: wide reaches make more of their triangles cross than they join.
  Result<bool> is_crowded() {
    A3D_ASSIGN(const std::vector<bool>* vertices, crowded());
    return 2 * std::ranges::count(*vertices, true) > std::ssize(*vertices);
  }

  RoundingJob& job;

 private:
  std::optional<RoundingCandidate> snapped_;
  std::optional<std::vector<bool>> crowded_;
};

/// From and to: how near to each other features are that a rung joins, or how wide the cells of its lattice, in
/// spacings.
struct Reach {
  double first = 0, last = 0;
};

Result<bool> always(Climb& /*climb*/) {
  return true;
}
Result<bool> of_multiples(Climb& climb) {
  return !climb.job.grid().is_floating();
}
Result<bool> of_multiples_of_solid(Climb& climb) {
  return climb.job.is_solid() && !climb.job.grid().is_floating();
}
Result<bool> of_part(Climb& climb) {
  return !climb.job.is_whole() && climb.job.grid().is_floating();
}
Result<bool> of_whole(Climb& climb) {
  return climb.job.is_whole();
}
Result<bool> of_whole_multiples(Climb& climb) {
  return climb.job.is_whole() && !climb.job.grid().is_floating();
}
Result<bool> of_sparse(Climb& climb) {
  if (!climb.job.is_whole()) return false;
  A3D_ASSIGN(const bool is_crowded, climb.is_crowded());
  return !is_crowded;
}
Result<bool> of_crowded(Climb& climb) {
  return climb.job.is_whole() ? climb.is_crowded() : Result<bool>(false);
}
Result<bool> of_whole_solid(Climb& climb) {
  return climb.job.is_whole() && climb.job.is_solid();
}

Result<bool> keep_faces(Climb& climb, Reach /*reach*/) {
  A3D_TRY(climb.job.begin("moving vertices"));
  return climb.job.accept_moved();
}

/// How far off the surface, in spacings, a corner at the rim of a closed gap is superfluous.
constexpr double kRimTolerance = 0x1p-20;

/// Removes the corners at the rims of closed gaps that lie inside facets or edges now.
Status smooth_rims(RoundingCandidate& candidate, const ClosedGaps& gaps, double tolerance, const Monitor& monitor) {
  std::vector<bool> may_change;
  for (const Vec3& place : candidate.mesh.points().approx()) may_change.push_back(gaps.rims.find(place) != kNone);
  TriangleStars stars(candidate.mesh);
  A3D_ASSIGN(const bool is_simpler, make_simpler(stars, may_change, tolerance, monitor));
  if (!is_simpler) return {};
  candidate.mesh = stars.mesh();
  candidate.movement = candidate.movement + Movement(rounded_up(2 * tolerance));
  return {};
}

/// Rounding moves the walls of a narrow gap, which may have other corners each, and so makes it as wide as the grid.
Result<bool> close_gaps(Climb& climb, Reach /*reach*/) {
  RoundingJob& job = climb.job;
  A3D_TRY(job.begin("closing gaps"));
  A3D_ASSIGN(const std::optional<ClosedGaps> closed,
             with_closed_gaps(job.mesh(), job.vertices(), job.spacing(), job.monitor()));
  if (!closed) return false;
  A3D_ASSIGN(RoundingCandidate candidate, with_moved_vertices(closed->mesh, closed->vertices, job.cancel()));
  candidate.method = RoundingMethod::gaps_closed;
  A3D_TRY(smooth_rims(candidate, *closed, kRimTolerance * job.spacing(), job.monitor()));
  return job.is_whole() ? divide_at_crossings(job, std::move(candidate)) : job.accept(candidate);
}

/// On a grid of multiples, which may be coarse, edges led round vertices may close a gap as wide as a triangle.
Result<bool> move_vertices(Climb& climb, Reach /*reach*/) {
  RoundingJob& job = climb.job;
  A3D_ASSIGN(const RoundingCandidate moved, with_moved_vertices(job.mesh(), job.vertices(), job.cancel()));
  return job.accept(moved);
}

Result<bool> lead_edges(Climb& climb, Reach /*reach*/) {
  A3D_TRY(climb.job.begin("leading edges round vertices"));
  A3D_ASSIGN(const RoundingCandidate* snapped, climb.snapped());
  return climb.job.accept(*snapped);
}

Result<bool> divide(Climb& climb, Reach /*reach*/) {
  RoundingJob& job = climb.job;
  A3D_ASSIGN(const RoundingCandidate moved, with_moved_vertices(job.mesh(), job.vertices(), job.cancel()));
  return divide_at_crossings(job, moved);
}

Result<bool> join(Climb& climb, Reach reach) {
  A3D_ASSIGN(const RoundingCandidate* snapped, climb.snapped());
  return join_features(climb.job, *snapped, {reach.first, reach.last});
}

Result<bool> make_coplanar(Climb& climb, Reach reach) {
  A3D_ASSIGN(const std::vector<bool>* crowded, climb.crowded());
  return join_coplanar(climb.job, *crowded, reach.first, reach.last);
}

/// The wider the lattices, the larger are the steps from one to the next.
Result<bool> thicken(Climb& climb, Reach reach) {
  A3D_ASSIGN(const std::vector<bool>* crowded, climb.crowded());
  const int first = std::ilogb(reach.first), last = std::ilogb(reach.last);
  return thicken_faces(climb.job, *crowded, {first, last, first < 20 ? 2 : 4});
}

Result<bool> cover(Climb& climb, Reach /*reach*/) {
  A3D_TRY(climb.job.begin(climb.job.is_solid() ? "covering with cubes" : "covering with faces of cubes"));
  return climb.job.accept_cover();
}

/// A rung of the ladder.
struct Rung {
  RoundingMethod method;
  Result<bool> (*is_for)(Climb&);
  std::string_view condition;  ///< of `is_for`, in words
  Reach reach;
  Result<bool> (*attempt)(Climb&, Reach);
  std::string_view promise;
  /// Tried also where a candidate was accepted that is not near enough: the nearer one is taken.
  bool may_better = false;
};

constexpr std::string_view kApart = "if no two meet and none comes to lie inside an edge or face";
constexpr std::string_view kMultiples = "with a grid width";
constexpr std::string_view kMerged = "with a grid width, vertices that meet becoming one";
constexpr std::string_view kGaps = "of a solid with a grid width, where gaps are nowhere wider than the grid";
constexpr std::string_view kPart = "of a part of a solid, to doubles or floats";
constexpr std::string_view kFewCrowded = "if at most 1,000 vertices are corners of triangles that cross";
constexpr std::string_view kSparse = "if at most half of the vertices are";
constexpr std::string_view kCrowded = "if more than half of the vertices are";

constexpr std::string_view kHalf = "half a spacing in each coordinate";
constexpr std::string_view kSome = "some spacings";
constexpr std::string_view kMostlyNear = "no limit, mostly 64 spacings";
constexpr std::string_view kNoLimit = "no limit";
constexpr std::string_view kCells = "64 cells of the lattice";

/// The ladder, in order. Where most vertices are crowded, joining within wide reaches makes more triangles cross than
/// before; where few are, it may be nearer than thickened faces, and has fewer triangles. Most features are joined
/// within a small reach, so that the rest needs a wide one in few places only.
std::span<const Rung> ladder() {
  using enum RoundingMethod;
  static constexpr Rung kLadder[] = {
      {gaps_closed, of_multiples_of_solid, kGaps, {}, close_gaps, kSome},
      {vertices_moved, always, kApart, {}, keep_faces, kHalf},
      {vertices_moved, of_multiples, kMerged, {}, move_vertices, kHalf},
      {edges_led_round, always, "", {}, lead_edges, kSome},
      {crossings_divided, of_whole_multiples, kMultiples, {}, divide, kSome},
      {features_joined, of_part, kPart, {32, 32}, join, kMostlyNear},
      {features_joined, of_whole, "", {8, 0x1p20}, join, kMostlyNear},
      {facets_made_coplanar, of_whole, kFewCrowded, {2, 32}, make_coplanar, kMostlyNear},
      {features_joined, of_sparse, kSparse, {0x1p20, 0x1p20}, join, kNoLimit},
      {faces_thickened, of_whole_solid, "of solids", {0x1p4, 0x1p18}, thicken, kMostlyNear, true},
      {features_joined, of_crowded, kCrowded, {0x1p20, 0x1p20}, join, kNoLimit},
      {facets_made_coplanar, of_whole, kFewCrowded, {128, 0x1p20}, make_coplanar, kNoLimit},
      {faces_thickened, of_whole_solid, "of solids", {0x1p20, 0x1p60}, thicken, kCells},
      {cover_of_cubes, of_whole, "faces of cubes for a surface; cannot fail", {}, cover, "the diagonal of a cube"},
  };
  return kLadder;
}

/// A reach in words: "", "32 spacings", "8 to 2^20 spacings".
std::string words(const Reach& reach) {
  const auto number = [](double spacings) {
    return spacings < 1000 ? fmt::format("{}", spacings) : fmt::format("2^{}", std::ilogb(spacings));
  };
  if (reach.last == 0) return "";
  if (reach.first == reach.last) return number(reach.last) + " spacings";
  return fmt::format("{} to {} spacings", number(reach.first), number(reach.last));
}

}  // namespace

Result<bool> climb_ladder(RoundingJob& job) {
  Climb climb(job);
  bool is_found = false;
  for (const Rung& rung : ladder()) {
    if (is_found && !rung.may_better) continue;
    A3D_ASSIGN(const bool is_for_job, rung.is_for(climb));
    if (!is_for_job) continue;
    A3D_ASSIGN(const bool is_accepted, rung.attempt(climb, rung.reach));
    is_found = is_found || is_accepted;
    if (is_found && job.accepted_distance() <= kNearEnough * job.spacing()) break;
  }
  return is_found;
}

std::vector<RungInWords> rounding_rungs() {
  std::vector<RungInWords> result;
  for (const Rung& rung : ladder())
    result.push_back({name_of(rung.method), rung.condition, words(rung.reach), rung.promise});
  return result;
}

}  // namespace algebra3d
