#include "algebra3d/rounding/detail/crossing_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "algebra3d/base/monitor.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/halfedge/box_hierarchy.h"

namespace algebra3d {
namespace {

using Corners = std::array<PointId, 3>;

/// The corners so that those that the other face has too stand first, and how many these are.
std::pair<Corners, std::size_t> shared_first(Corners corners, const Corners& other) {
  auto* const rest = std::partition(corners.begin(), corners.end(),
                                    [&](PointId p) { return std::ranges::find(other, p) != other.end(); });
  return {corners, static_cast<std::size_t>(rest - corners.begin())};
}

bool do_cross(const SnappedFaces& faces, std::size_t f, std::size_t g) {
  auto [s, shared] = shared_first(faces.corners(f), faces.corners(g));
  const auto at = [&](PointId p) { return faces.point(p); };
  if (shared == 0) {
    const Contact contact = intersect_triangles(faces.triangle(f), faces.triangle(g));
    return contact == Contact::segment || contact == Contact::area;
  }
  const Corners t = shared_first(faces.corners(g), faces.corners(f)).first;
  if (shared == 1) return meet_beyond_shared_vertex(at(s[0]), at(s[1]), at(s[2]), at(t[1]), at(t[2]));
  return shared == 2 && overlap_beyond_shared_edge(at(s[0]), at(s[1]), at(s[2]), at(t[2]));
}

}  // namespace

Result<std::vector<FacePair>> crossing_faces(const SnappedFaces& faces, const std::atomic<bool>* cancel) {
  std::vector<std::uint32_t> all, open;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto [a, b, c] = faces.triangle(f);
    if (collinear(a, b, c)) continue;
    all.push_back(f);
    if (faces.is_open(f)) open.push_back(f);
  }
  const TriangleMesh mesh = faces.mesh();
  const Monitor monitor(cancel);
  std::vector<FacePair> pairs;
  const BoxHierarchy of_all(mesh, std::move(all)), of_open(mesh, std::move(open));
  const auto visit = [&](std::uint32_t f, std::uint32_t g) {  // an open one, and any
    const bool comes_twice = faces.is_open(g) && f >= g;
    if (!comes_twice && do_cross(faces, f, g)) pairs.emplace_back(std::min(f, g), std::max(f, g));
    return true;
  };
  of_open.for_each_pair_with(of_all, visit, [&] { return !monitor.is_cancelled(); });
  ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace algebra3d
