#include "algebra3d/kernel/rounding/detail/turn_distance.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/kernel/distance/covering_bound.h"
#include "algebra3d/kernel/distance/distance_bound.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
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

}  // namespace

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

}  // namespace algebra3d
