#include "algebra3d/rounding/detail/thickening.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"
#include "algebra3d/rounding/detail/rounding_rungs.h"
#include "algebra3d/rounding/detail/snap_rounding.h"
#include "algebra3d/rounding/detail/thickened_faces.h"

namespace algebra3d {
namespace {

/// How high the prisms are, in cells. With a half or a whole cell, faces of neighbouring prisms would lie upon each
/// other in part.
constexpr double kHeight = 0.75;
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

/// Makes candidates for one job.
class Thickening {
 public:
  Thickening(RoundingJob& job, const std::vector<bool>& crowded)
      : job_(job), shells_(divided_shells(with_its_faces(job.mesh(), job.vertices()).mesh, crowded)) {}

  /// True if enough cells fit into the solid, and a few beside it into the range of the grid.
  bool has_room_for(double cell) const {
    const Box3 box = Box3::around(job_.vertices().points.approx());
    const Vec3 size = box.max - box.min;
    const bool is_in_range = std::isfinite(job_.grid().nearest(job_.size() + 4 * cell));
    return is_in_range && std::max({size.x, size.y, size.z}) >= kFewestCells * cell;
  }
  /// Nothing if that is too much work.
  Result<std::optional<RoundingCandidate>> candidate(double cell) const;

 private:
  RoundingJob& job_;
  Shells shells_;
};

Result<std::optional<RoundingCandidate>> Thickening::candidate(double cell) const {
  const RoundedVertices on_lattice = rounded_vertices(shells_.crowded, CoordinateGrid::multiples(cell));
  ALGEBRA3D_ASSIGN_OR_RETURN(const SnappedMesh moved, moved_mesh(shells_.crowded, on_lattice.points, job_.cancel()));
  const TriangleMesh thick = together(thickened_faces(moved.mesh, {cell, kHeight * cell}), shells_.others);
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::optional<TriangleMesh> divided, job_.divided(thick, kMaxPairs));
  if (!divided) return std::optional<RoundingCandidate>();
  const RoundedVertices vertices = rounded_vertices(*divided, job_.grid());
  ALGEBRA3D_ASSIGN_OR_RETURN(RoundingCandidate result, snap_rounded(*divided, vertices, job_.cancel()));
  const double to_lattice = job_.vertices().largest_movement + on_lattice.largest_movement + kHeight * cell;
  result.movement = result.movement + Movement(rounded_up(to_lattice));
  result.reach = cell;
  result.method = RoundingMethod::faces_thickened;
  return std::optional(std::move(result));
}

}  // namespace

Result<bool> thicken_faces(RoundingJob& job, const std::vector<bool>& crowded, const ThickeningSteps& steps) {
  if (std::ranges::none_of(crowded, [](bool is_crowded) { return is_crowded; })) return false;
  const Thickening thickening(job, crowded);
  for (int exponent = steps.first; exponent <= steps.last; exponent += steps.step) {
    const double cells = std::ldexp(1.0, exponent);
    if (!thickening.has_room_for(cells * job.spacing())) return false;
    ALGEBRA3D_ASSIGN_OR_RETURN(std::optional<RoundingCandidate> candidate, thickening.candidate(cells * job.spacing()));
    if (!candidate) continue;
    ALGEBRA3D_ASSIGN_OR_RETURN(bool is_accepted, job.accept(*candidate));
    if (!is_accepted) {
      ALGEBRA3D_ASSIGN_OR_RETURN(
          is_accepted,
          join_features(job, *std::move(candidate), job.grid(),
                        {kFirstJoiningReach, std::max(kFirstJoiningReach, kLastJoiningReach * cells), true}));
    }
    if (is_accepted) return true;
  }
  return false;
}

}  // namespace algebra3d
