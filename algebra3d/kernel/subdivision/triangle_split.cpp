#include "algebra3d/kernel/subdivision/detail/triangle_split.h"

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/provenance.h"
#include "base/indices.h"

namespace algebra3d::subdivision {

Provenance triangle_split_provenance(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given) {
  const PolygonMesh& mesh = input.mesh;
  Provenance provenance{{}, ElementBlends(mesh)};
  auto& [sources, blends] = provenance;
  if (given.has(MeshElement::vertex)) sources.vertices = vertices_and_middles(mesh, blends.vertices);
  if (given.has(MeshElement::halfedge)) {
    const ValueSources middles = corner_middles(mesh, blends.halfedges);
    sources.halfedges.resize(after.halfedge_count());
    for (const HalfedgeId h : halfedges(mesh)) {
      poll_interruption_at(h.index());
      const std::size_t start = TriangleSplit::first_half(h).index();
      sources.halfedges[start] = h.index();
      sources.halfedges[start + 1] = sources.halfedges[TriangleSplit::middle(h).index()] = middles[h.index()];
      sources.halfedges[start + 2] = middles[mesh.prev(h).index()];
    }
  }
  if (given.has(MeshElement::edge)) {
    // Per half-edge of the result the one that it is a half of.
    ValueSources along(after.halfedge_count(), kNone);
    for (const HalfedgeId h : halfedges(mesh)) {
      poll_interruption_at(h.index());
      for (const HalfedgeId half : {TriangleSplit::first_half(h), TriangleSplit::second_half(h)})
        along[half.index()] = h.index();
    }
    sources.edges = edge_sources(after, mesh, along);
  }
  if (given.has(MeshElement::face))
    for (const FaceId f : faces(mesh)) sources.faces.insert(sources.faces.end(), 4, f.index());
  return provenance;
}

}  // namespace algebra3d::subdivision
