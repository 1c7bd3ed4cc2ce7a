#include "algebra3d/kernel/halfedge/edge_balance.h"

#include <algorithm>
#include <cstddef>

namespace algebra3d {

void EdgeBalance::add(const PointRef& from, const PointRef& to, int count) {
  const std::uint32_t first = places_.intern(from), second = places_.intern(to);
  if (first < second)
    excess_[{first, second}] += count;
  else if (second < first)
    excess_[{second, first}] -= count;
}

void EdgeBalance::add(const TriangleMesh& mesh, HalfedgeId halfedge, int count) {
  add(mesh.point(mesh.origin(halfedge)), mesh.point(mesh.target(halfedge)), count);
}

void EdgeBalance::add(const TriangleMesh& mesh, int count) {
  for (std::size_t i = 0; i < mesh.halfedge_count(); ++i)
    if (const HalfedgeId h(i); !mesh.opposite(h).is_valid()) add(mesh, h, count);
}

bool EdgeBalance::is_zero() const {
  return std::ranges::all_of(excess_, [](const auto& edge) { return edge.second == 0; });
}

}  // namespace algebra3d
