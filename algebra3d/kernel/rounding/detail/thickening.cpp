#include "algebra3d/kernel/rounding/detail/thickening.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/distance/covering_bound.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/paired_faces.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/rounding/detail/rounding_rungs.h"
#include "algebra3d/kernel/rounding/detail/snap_rounding.h"
#include "algebra3d/kernel/rounding/detail/thickened_faces.h"
#include "algebra3d/kernel/rounding/detail/triangle_stars.h"
#include "algebra3d/kernel/rounding/detail/vertex_removal.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// How high the prisms are, in cells. With a half or a whole cell, faces of neighbouring prisms would lie upon each
/// other in part.
constexpr double kHeight = 0.75;
/// Within how many cells of the surface corners are removed from the shells, and from the result of adding prisms.
constexpr double kShellTolerance = 1;
constexpr double kThickTolerance = 0.3;
/// How many cells a candidate may be away from the given boundary.
constexpr double kMostCellsAway = 64;
/// How many pieces a bound of a distance may take, a microsecond or two each.
constexpr std::size_t kMaxPiecesOfThick = 2'000'000;
/// How many cells must fit into the longest side of the solid.
constexpr double kFewestCells = 1024;
/// How many pairs of triangles may touch, some microseconds each; prisms that nearly coincide have many.
constexpr std::size_t kMaxPairs = 10'000'000;
/// The first reach within which features are joined in spacings, and the last one in cells.
constexpr double kFirstJoiningReach = 8;
constexpr double kLastJoiningReach = 0.5;

/// The rounded mesh in two: whole shells with crowded vertices, and the others.
struct Shells {
  TriangleMesh crowded, others;
};

Shells divided_shells(const TriangleMesh& mesh, const std::vector<bool>& crowded) {
  const FaceComponents shells = connected_components(mesh);
  std::vector<bool> is_crowded(shells.count);
  for (const FaceId face : faces(mesh))
    if (std::ranges::any_of(mesh.triangle(face), [&](std::uint32_t v) -> bool { return crowded[v]; }))
      is_crowded[shells.of_face[face.index()]] = true;
  std::vector<FaceId> chosen, rest;
  for (const FaceId face : faces(mesh)) (is_crowded[shells.of_face[face.index()]] ? chosen : rest).push_back(face);
  return {submesh(mesh, chosen), submesh(mesh, rest)};
}

/// The triangles of both meshes, which have double coordinates.
TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> points = a.points().approx();
  points.insert(points.end(), b.points().approx().begin(), b.points().approx().end());
  std::vector<TriangleMesh::Triangle> triangles;
  triangles.reserve(a.face_count() + b.face_count());
  for (const FaceId face : faces(a)) triangles.push_back(a.triangle(face));
  const auto shift = static_cast<std::uint32_t>(a.vertex_count());
  for (const FaceId face : faces(b)) {
    const auto [u, v, w] = b.triangle(face);
    triangles.push_back({u + shift, v + shift, w + shift});
  }
  return {PointArray(std::move(points)), triangles};
}

/// The mesh without corners within a distance of its surface, those of needles and folds included.
Result<TriangleMesh> simplified(const TriangleMesh& mesh, double tolerance, const Monitor& monitor) {
  const TriangleMesh paired = with_paired_faces(mesh);
  TriangleStars stars(paired);
  const std::vector<bool> may_go(paired.vertex_count(), true);
  A3D_TRY(remove_superfluous_vertices(stars, may_go, tolerance, monitor, ThinTriangles::allowed));
  return stars.mesh();
}

/// Makes candidates for one job.
class Thickening {
 public:
  Thickening(RoundingJob& job, const std::vector<bool>& crowded)
      : job_(job),
        rounded_(with_its_faces(job.mesh(), job.vertices()).mesh),
        hierarchy_(rounded_),
        box_(Box3::around(rounded_.points().approx())),
        shells_(divided_shells(rounded_, crowded)) {}

  /// True if enough cells fit into the solid, and a few beside it into the range of the grid.
  bool has_room_for(double cell) const {
    const Vec3 size = box_.max - box_.min;
    const bool is_in_range = std::isfinite(job_.grid().nearest(job_.size() + kMostCellsAway * cell));
    return is_in_range && std::max({size.x, size.y, size.z}) >= kFewestCells * cell;
  }
  /// Nothing if that is too much work, or too far away.
  Result<std::optional<RoundingCandidate>> candidate(double cell) const;

 private:
  Result<std::optional<TriangleMesh>> thick_mesh(double cell) const;

  RoundingJob& job_;
  TriangleMesh rounded_;  // each vertex by itself, whatever then crosses
  BoxHierarchy hierarchy_;
  Box3 box_;
  Shells shells_;
};

/// The shells with prisms over their faces, divided exactly where these cross.
Result<std::optional<TriangleMesh>> Thickening::thick_mesh(double cell) const {
  A3D_ASSIGN(const TriangleMesh simple, simplified(shells_.crowded, kShellTolerance * cell, job_.cancel()));
  const RoundedVertices on_lattice = rounded_vertices(simple, CoordinateGrid::multiples(cell));
  A3D_ASSIGN(const SnappedMesh moved, moved_mesh(simple, on_lattice.points, job_.cancel()));
  return job_.divided(together(thickened_faces(moved.mesh, {cell, kHeight * cell}), shells_.others), kMaxPairs);
}

Result<std::optional<RoundingCandidate>> Thickening::candidate(double cell) const {
  A3D_ASSIGN(const std::optional<TriangleMesh> thick, thick_mesh(cell));
  if (!thick) return std::optional<RoundingCandidate>();
  A3D_ASSIGN(RoundingCandidate result, snap_rounded(*thick, rounded_vertices(*thick, job_.grid()), job_.cancel()));
  A3D_ASSIGN(result.mesh, simplified(result.mesh, kThickTolerance * cell, job_.cancel()));
  A3D_ASSIGN(const std::optional<double> distance,
             covering_bound(result.mesh, {&rounded_, &hierarchy_}, cell, kMaxPiecesOfThick, job_.cancel()));
  if (!distance || *distance > kMostCellsAway * cell) return std::optional<RoundingCandidate>();
  const double in_all = job_.vertices().largest_movement + *distance;
  result.movement = Movement(rounded_up(in_all + length(box_.max - box_.min)), rounded_up(in_all));
  result.reach = cell;
  result.method = RoundingMethod::faces_thickened;
  return std::optional(std::move(result));
}

}  // namespace

Result<bool> thicken_faces(RoundingJob& job, const std::vector<bool>& crowded, const ThickeningSteps& steps) {
  if (std::ranges::none_of(crowded, [](bool is_crowded) { return is_crowded; })) return false;
  const Thickening thickening(job, crowded);
  for (int exponent = steps.first; exponent <= steps.last; exponent += steps.step) {
    const double cells = std::ldexp(1.0, exponent), cell = cells * job.spacing();
    if (!thickening.has_room_for(cell) || cell >= job.accepted_distance()) return false;
    A3D_TRY(job.begin(fmt::format("thickening faces, on a lattice of 2^{} spacings", exponent)));
    A3D_ASSIGN(std::optional<RoundingCandidate> candidate, thickening.candidate(cell));
    if (!candidate || candidate->movement.distance >= job.accepted_distance()) continue;
    A3D_ASSIGN(bool is_accepted, job.accept(*candidate));
    if (!is_accepted) {
      A3D_ASSIGN(is_accepted,
                 join_features(job, *std::move(candidate),
                               {kFirstJoiningReach, std::max(kFirstJoiningReach, kLastJoiningReach * cells), true}));
    }
    if (is_accepted) return true;
  }
  return false;
}

}  // namespace algebra3d
