#include "algebra3d/kernel/rounding/detail/rounding_rungs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/distance/covering_bound.h"
#include "algebra3d/kernel/distance/distance_bound.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/edge_balance.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/cell_cover.h"
#include "algebra3d/kernel/rounding/detail/coplanar_snapping.h"
#include "algebra3d/kernel/rounding/detail/feature_snapping.h"
#include "algebra3d/kernel/rounding/detail/met_cells.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/rounding/detail/snap_rounding.h"
#include "algebra3d/kernel/rounding/detail/solid_part.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// How many pieces a bound by pieces of triangles may take, a microsecond or two each.
constexpr std::size_t kMaxPieces = 1'000'000;

/// The corners of a face by the numbers of their places, ascending; kNone for places that are not in the table.
std::array<std::uint32_t, 3> places_of(const TriangleMesh& mesh, FaceId face, const PointTable& places) {
  std::array<std::uint32_t, 3> result{};
  std::ranges::transform(mesh.corners(face), result.begin(), [&](const PointRef& p) { return places.find(p); });
  std::ranges::sort(result);
  return result;
}

/// The faces of a mesh that have not the corners of one of another mesh.
std::vector<FaceId> faces_that_differ(const TriangleMesh& mesh, const TriangleMesh& other) {
  PointTable places(other.vertex_count());
  for (std::size_t v = 0; v < other.vertex_count(); ++v) places.intern(other.points()[v]);
  std::vector<std::array<std::uint32_t, 3>> known;
  known.reserve(other.face_count());
  for (const FaceId face : faces(other)) known.push_back(places_of(other, face, places));
  std::ranges::sort(known);
  std::vector<FaceId> result;
  for (const FaceId face : faces(mesh))
    if (!std::ranges::binary_search(known, places_of(mesh, face, places))) result.push_back(face);
  return result;
}

/// Replaces the distance of a candidate of several turns, which is a sum over the turns, by a bound measured against
/// `first`, the candidate before the first turn: faces that both have are at distance 0. `small`: distances up to that
/// need no better bound. `farthest`: the largest distance of one turn. Errors: interrupted. Cost: linear, and that of
/// bounded_distance and covering_bound for the other faces.
Status tighten_distance(RoundingCandidate& candidate, const RoundingCandidate& first, double small, double farthest,
                        const std::atomic<bool>* cancel) {
  double distance = candidate.movement.distance - first.movement.distance;
  if (distance <= small) return {};
  const BoxHierarchy hierarchy(first.mesh);
  const DistanceOperand from_first{&first.mesh, &hierarchy};
  const TriangleMesh changed = submesh(candidate.mesh, faces_that_differ(candidate.mesh, first.mesh));
  if (distance > farthest) {
    A3D_ASSIGN(distance, bounded_distance(changed, distance, from_first, std::max(small, farthest), cancel));
  }
  if (distance > small) {  // near needles that bound, and that of one turn, may be far too large
    A3D_ASSIGN(const std::optional<double> covering,
               covering_bound(changed, from_first, small / 4, kMaxPieces, cancel));
    distance = std::min(distance, covering.value_or(distance));
  }
  candidate.movement.distance = first.movement.distance + distance;
  return {};
}

/// More crowded vertices are not made coplanar: that takes rationals, whose digits multiply where many facets are near.
constexpr std::ptrdiff_t kMaxCrowded = 1000;
/// Limit of the triangles, over all reaches, for which facets are made coplanar: half a millisecond each.
constexpr std::size_t kMaxCoplanarTriangles = 600;
/// Pairs of triangles that may touch after that, some ten microseconds each, for each given triangle and in all.
constexpr std::size_t kCoplanarPairs = 100;
constexpr std::size_t kLeastCoplanarPairs = 5000;

/// Sums of distances up to so many spacings need no better bound.
constexpr double kSmallSumOfDistances = 16;

/// How much wider reaches get from one attempt to the next.
constexpr double kReachGrowth = 4;

/// How often a mesh is only divided at its crossings, before features are joined.
constexpr int kMaxDivisions = 4;

/// How often features are joined and cells selected in one rung; and how many crossings need not become fewer.
constexpr int kMaxTurns = 10;
constexpr std::size_t kToleratedCrossings = 20;
/// So many crossings that do not become fewer are given a wider reach; with more, needles would pile up.
constexpr std::size_t kFewCrossingsLeft = 100;

/// The work of joining features in all turns of a rung, beside that for each triangle; and of a turn for each triangle,
/// which is searched for crossings and divided.
constexpr std::size_t kLeastWork = 8000;
constexpr std::size_t kWorkOfTurn = 2;

/// The work that the turns of a rung may do: counted, not timed, so that a result does not depend on the machine.
class JoiningWork {
 public:
  JoiningWork(const TriangleMesh& given, std::size_t per_face) : left_(kLeastWork + per_face * given.face_count()) {}
  std::size_t left() const { return left_; }
  void add(std::size_t work) { left_ -= std::min(work, left_); }

 private:
  std::size_t left_;
};

/// A limit of the triangles of what is divided again.
std::size_t max_faces(const TriangleMesh& given) {
  return given.face_count() + given.face_count() / 4 + 250;
}

/// The mesh snap rounded near the vertices that move, of which there are few, or altogether if those edges change there
/// that the rest has, too. An edge of the rest that passes near a moved vertex may cross something, which comes to
/// light with the other crossings.
Result<RoundingCandidate> snap_rounded_near_moved(TriangleMesh mesh, const CoordinateGrid& grid,
                                                  const std::atomic<bool>* cancel) {
  const std::vector<bool> is_moved = are_moved(mesh, grid);
  if (std::ranges::find(is_moved, true) == is_moved.end()) return RoundingCandidate{std::move(mesh)};
  const SolidPart part(mesh, is_moved);
  A3D_ASSIGN(RoundingCandidate snapped, snap_rounded(part.mesh(), rounded_vertices(part.mesh(), grid), cancel));
  if (part.is_whole()) return snapped;
  EdgeBalance balance;
  balance.add(part.mesh(), 1);
  balance.add(snapped.mesh, -1);
  if (!balance.is_zero()) return snap_rounded(mesh, rounded_vertices(mesh, grid), cancel);
  snapped.mesh = part.solid_with(std::move(snapped.mesh));
  return snapped;
}

/// Rounds the new corners of a mesh that was divided at its crossings. False if no division was made.
Result<bool> round_divided(const RoundingJob& job, std::optional<TriangleMesh> divided, RoundingCandidate& candidate) {
  if (!divided) return false;
  A3D_ASSIGN(RoundingCandidate snapped, snap_rounded_near_moved(*std::move(divided), job.grid(), job.cancel()));
  candidate.mesh = std::move(snapped.mesh);
  candidate.movement = candidate.movement + snapped.movement;
  return true;
}

/// Divides the candidate at its crossings, and rounds the new corners. False if that is too much.
Result<bool> divide(const RoundingJob& job, RoundingCandidate& candidate) {
  A3D_ASSIGN(std::optional<TriangleMesh> divided, job.divided(candidate.mesh));
  return round_divided(job, std::move(divided), candidate);
}

/// Puts the joined mesh in place of the candidate's.
void take(RoundingCandidate& candidate, FeatureSnappedMesh joined) {
  candidate.mesh = *std::move(joined.mesh);
  candidate.movement = candidate.movement + Movement(joined.largest_displacement, joined.largest_distance);
  candidate.reach = std::max(candidate.reach, joined.reach);
  if (joined.reach > 0) candidate.method = std::max(candidate.method, RoundingMethod::features_joined);
}

/// Joins features of the mesh whose facets were made coplanar within a reach in coordinate units.
Result<bool> join_moved(RoundingJob& job, const MovedVertices& moved, double reach, double largest_reach) {
  A3D_ASSIGN(SnappedMesh snapped, snap_round(job.mesh(), moved, job.cancel()));
  const double farthest = std::ranges::max(moved.movements);
  RoundingCandidate coplanar{std::move(snapped.mesh), Movement(rounded_up(farthest + snapped.largest_detour)), reach,
                             RoundingMethod::facets_made_coplanar};
  const std::size_t max_pairs = kCoplanarPairs * job.mesh().face_count() + kLeastCoplanarPairs;
  A3D_ASSIGN(std::optional<TriangleMesh> divided, job.divided(coplanar.mesh, max_pairs));
  A3D_ASSIGN(const bool is_divided, round_divided(job, std::move(divided), coplanar));
  return is_divided ? join_features(job, std::move(coplanar), {largest_reach, largest_reach}) : Result<bool>(false);
}

}  // namespace

Result<bool> divide_at_crossings(RoundingJob& job, RoundingCandidate candidate) {
  for (int i = 0; i < kMaxDivisions; ++i) {
    A3D_TRY(job.begin("dividing where triangles cross"));
    A3D_ASSIGN(const std::optional<TriangleMesh> divided, job.divided(candidate.mesh));
    if (!divided || divided->face_count() > max_faces(job.mesh())) return false;
    const Movement moved_before = candidate.movement;
    const RoundingMethod method = std::max(candidate.method, RoundingMethod::crossings_divided);
    A3D_ASSIGN(candidate, with_moved_vertices(*divided, rounded_vertices(*divided, job.grid()), job.cancel()));
    candidate.movement = moved_before + candidate.movement;
    candidate.method = method;
    A3D_ASSIGN(const bool is_accepted, job.accept(candidate));
    if (is_accepted) return true;
  }
  return false;
}

Result<bool> join_features(RoundingJob& job, RoundingCandidate candidate, const JoiningReach& reaches) {
  const double spacing = job.spacing();
  const RoundingCandidate first = candidate;
  std::size_t most_crossings = SIZE_MAX;
  double reach = reaches.first;
  double farthest = 0;  // of one turn
  JoiningWork work(job.mesh(), reaches.most_work);
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    A3D_TRY(job.begin(fmt::format("joining features, turn {}", turn + 1)));
    A3D_ASSIGN(FeatureSnappedMesh joined,
               snap_features(candidate.mesh, job.grid(), spacing, {reach, most_crossings, work.left()}, job.cancel(),
                             job.folded()));
    work.add(joined.work + kWorkOfTurn * candidate.mesh.face_count());
    if (!joined.mesh) {
      if (work.left() == 0 || reach >= reaches.last || joined.crossings_before > kFewCrossingsLeft) return false;
      reach = std::min(kReachGrowth * reach, reaches.last);
      most_crossings = SIZE_MAX;
      continue;
    }
    farthest = std::max(farthest, joined.largest_distance);
    const std::size_t crossings_before = joined.crossings_before;
    const bool is_simple = joined.crossing_pairs == 0;
    take(candidate, std::move(joined));
    if (is_simple) {
      A3D_TRY(tighten_distance(candidate, first, kSmallSumOfDistances * spacing, farthest, job.cancel()));
      A3D_ASSIGN(const bool is_accepted, job.accept(candidate));
      if (is_accepted) return true;
    }
    const bool grows = candidate.mesh.face_count() > 2 * std::max(max_faces(job.mesh()), max_faces(first.mesh));
    if (!job.is_whole() || grows || work.left() == 0) return false;
    most_crossings = crossings_before / 2 + kToleratedCrossings;
    if (reaches.must_fall) most_crossings = std::min(most_crossings, std::max<std::size_t>(crossings_before, 1) - 1);
    A3D_ASSIGN(const bool is_divided, divide(job, candidate));
    if (!is_divided) return false;
  }
  return false;
}

Result<std::vector<bool>> crowded_vertices(const RoundingJob& job, const TriangleMesh& snapped) {
  A3D_ASSIGN(const std::vector<Entanglement> entanglements, disentangle(snapped, job.cancel()));
  std::set<Vec3> places;
  for (const FaceId face : faces(snapped))
    if (entanglements[face.index()] != Entanglement::none)
      for (const PointRef& corner : snapped.corners(face)) places.insert(corner.approx);
  std::vector<bool> are_crowded;
  for (const Vec3& place : job.vertices().points.approx()) are_crowded.push_back(places.contains(place));
  return are_crowded;
}

Result<bool> join_coplanar(RoundingJob& job, const std::vector<bool>& crowded, double first_reach,
                           double largest_reach) {
  if (std::ranges::count(crowded, true) > kMaxCrowded) return false;
  std::vector<double> movements(job.mesh().vertex_count());  // of the reach before
  double reach = first_reach;
  std::size_t triangles = 0;  // of all attempts
  bool is_found = false;
  while (!is_found && reach <= largest_reach && triangles < kMaxCoplanarTriangles) {
    A3D_TRY(job.begin("making facets coplanar"));
    const MovedVertices moved = snap_coplanar(job.mesh(), crowded, reach * job.spacing());
    if (moved.movements != movements) {
      A3D_ASSIGN(is_found, join_moved(job, moved, reach * job.spacing(), largest_reach));
      movements = moved.movements;
      triangles += job.mesh().face_count();
    }
    reach *= kReachGrowth;
  }
  return is_found;
}

Result<std::optional<RoundingCandidate>> cover_of_cubes(const TriangleMesh& solid, const CoordinateGrid& grid,
                                                        std::size_t budget, const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const std::optional<MetCells> met, finest_met_cells(solid, grid, budget, cancel));
  if (!met) return std::optional<RoundingCandidate>();
  A3D_ASSIGN(TriangleMesh boundary, CellCover(solid, *met).boundary(cancel));
  return std::optional(
      RoundingCandidate{std::move(boundary), Movement(met->lattice.diagonal()), 0, RoundingMethod::cover_of_cubes});
}

}  // namespace algebra3d
