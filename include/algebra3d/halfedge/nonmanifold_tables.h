#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// Side tables of a mesh with non-manifold parts, used by the mesh, its builder and its auditor only. Lists of lists in
/// flat arrays: list n lies between starts[n] and starts[n + 1].
struct NonManifoldTables {
  std::vector<std::uint32_t> edge_starts{0};
  std::vector<HalfedgeId> edge_halfedges;  ///< ascending within an edge; edges ordered by their first half-edge
  std::vector<std::uint32_t> vertices;     ///< ascending
  std::vector<std::uint32_t> fan_starts{0};
  std::vector<HalfedgeId> fans;  ///< ascending within a vertex
};

}  // namespace algebra3d
