#pragma once

#include <vector>

#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// A maximal chain of boundary half-edges with their faces to the left.
struct BoundaryLoop {
  std::vector<HalfedgeId> halfedges;
  /// False for a chain that ends at non-manifold edges.
  bool is_closed = true;
};

}  // namespace algebra3d
