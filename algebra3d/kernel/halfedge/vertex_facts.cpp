#include "algebra3d/kernel/halfedge/vertex_facts.h"

#include "algebra3d/kernel/halfedge/adjacency.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/normals.h"

namespace algebra3d {
namespace {

/// A vertex with so many edges is a hub.
constexpr std::size_t kHubValence = 32;

}  // namespace

template <typename Layout>
VertexFacts facts_of(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  VertexFacts facts{valence(mesh, v), vertex_normal(mesh, v)};
  for (const HalfedgeId h : outgoing_halfedges(mesh, v))
    facts.is_boundary = facts.is_boundary || mesh.is_boundary(h) || mesh.is_boundary(mesh.prev(h));
  return facts;
}

template <typename Layout>
VertexFacts HubFacts::of(const HalfedgeMesh<Layout>& mesh, VertexId v) const {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto kept = kept_.find(v); kept != kept_.end()) return kept->second;
  }
  const VertexFacts facts = facts_of(mesh, v);
  if (facts.valence >= kHubValence) {
    const std::scoped_lock lock(mutex_);
    kept_.emplace(v, facts);
  }
  return facts;
}

template VertexFacts facts_of(const HalfedgeMesh<TriangleLayout>&, VertexId);
template VertexFacts facts_of(const HalfedgeMesh<PolygonLayout>&, VertexId);
template VertexFacts HubFacts::of(const HalfedgeMesh<TriangleLayout>&, VertexId) const;
template VertexFacts HubFacts::of(const HalfedgeMesh<PolygonLayout>&, VertexId) const;

}  // namespace algebra3d
