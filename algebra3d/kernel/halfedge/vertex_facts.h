#pragma once

#include <cstddef>
#include <mutex>
#include <unordered_map>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

namespace algebra3d {

/// Properties of a vertex that depend on all faces at it.
struct VertexFacts {
  std::size_t valence = 0;   ///< number of edges
  Vec3 normal;               ///< as vertex_normal gives it
  bool is_boundary = false;  ///< an edge with one face ends there
};

/// The facts of a vertex. Exactness: as vertex_normal. Cost: linear in the faces at the vertex.
template <typename Layout>
VertexFacts facts_of(const HalfedgeMesh<Layout>& mesh, VertexId v);

/// The facts of the vertices of one mesh, kept where there are many faces at a vertex, a *hub*: so the neighbourhoods
/// of all elements together cost no more than their rows. Concurrent calls are safe.
class HubFacts {
 public:
  /// Cost: that of facts_of, for a hub once; then constant.
  template <typename Layout>
  VertexFacts of(const HalfedgeMesh<Layout>& mesh, VertexId v) const;

 private:
  mutable std::mutex mutex_;
  mutable std::unordered_map<VertexId, VertexFacts> kept_;
};

}  // namespace algebra3d
