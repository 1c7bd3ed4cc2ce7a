#include "algebra3d/kernel/halfedge/edge_balance.h"

#include <algorithm>
#include <cstddef>

namespace algebra3d {

void EdgeBalance::add(const TriangleMesh& mesh, HalfedgeId halfedge, int count) {
  const std::uint32_t from = places_.intern(mesh.point(mesh.origin(halfedge)));
  const std::uint32_t to = places_.intern(mesh.point(mesh.target(halfedge)));
  if (from < to)
    excess_[{from, to}] += count;
  else if (to < from)
    excess_[{to, from}] -= count;
}

void EdgeBalance::add(const TriangleMesh& mesh, int count) {
  for (std::size_t i = 0; i < mesh.halfedge_count(); ++i)
    if (const HalfedgeId h(i); !mesh.opposite(h).is_valid()) add(mesh, h, count);
}

bool EdgeBalance::is_zero() const {
  return std::ranges::all_of(excess_, [](const auto& edge) { return edge.second == 0; });
}

}  // namespace algebra3d
