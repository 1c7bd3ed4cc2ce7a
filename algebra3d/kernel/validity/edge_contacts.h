#pragma once

#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/face_pairs.h"

namespace algebra3d {

/// An edge by its ends, the lower number first.
using EdgeEnds = std::pair<VertexId, VertexId>;

/// Two edges that cross in a point inside both. Valid surfaces and volumes may have such points of contact, as where
/// two solids touch; programs that read a mesh often take them for crossings.
struct EdgeContact {
  EdgeEnds first, second;  ///< the lower one first
  ExactPoint point;
};

/// The contacts of edges of `touching` faces (contacts.h), each once, ascending. Exact. Cost: near-linear in the pairs.
std::vector<EdgeContact> edge_contacts(const TriangleMesh& mesh, const FacePairs& touching);

}  // namespace algebra3d
