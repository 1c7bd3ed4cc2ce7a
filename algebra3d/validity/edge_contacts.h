#pragma once

#include <atomic>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// An edge by its ends, the lower number first.
using EdgeEnds = std::pair<VertexId, VertexId>;

/// Two edges that cross in a point inside both. Valid surfaces and volumes may have such points of contact, as where
/// two solids touch; programs that read a mesh often take them for crossings.
struct EdgeContact {
  EdgeEnds first, second;  ///< the lower one first
  ExactPoint point;
};

/// All contacts of edges in a valid surface or volume, each once, ascending. Exact. Errors: interrupted. Cost: that of
/// the pairs of boxes of its faces.
Result<std::vector<EdgeContact>> edge_contacts(const TriangleMesh& mesh, const std::atomic<bool>* cancel);

}  // namespace algebra3d
