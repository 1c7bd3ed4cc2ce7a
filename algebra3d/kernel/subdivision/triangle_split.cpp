#include "algebra3d/kernel/subdivision/detail/triangle_split.h"

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/provenance.h"

namespace algebra3d::subdivision {

Provenance triangle_split_provenance(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given) {
  const PolygonMesh& mesh = input.mesh;
  Provenance provenance{{}, ElementBlends(mesh)};
  auto& [sources, blends] = provenance;
  if (given.has(MeshElement::vertex)) sources.vertices = vertices_and_middles(mesh, blends.vertices);
  if (given.has(MeshElement::halfedge)) {
    const std::vector<std::uint32_t> middles = corner_middles(mesh, blends.halfedges);
    sources.halfedges.resize(after.halfedge_count());
    for (const HalfedgeId id : halfedges(mesh)) {
      poll_interruption_at(id.index());
      const std::uint32_t h = id.index(), start = TriangleSplit::first_half(h);
      sources.halfedges[start] = h;
      sources.halfedges[start + 1] = sources.halfedges[TriangleSplit::middle(h)] = middles[h];
      sources.halfedges[start + 2] = middles[mesh.prev(id).index()];
    }
  }
  if (given.has(MeshElement::edge)) {
    // Per half-edge of the result the one that it is a half of.
    std::vector<std::uint32_t> along(after.halfedge_count(), kNone);
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      poll_interruption_at(h);
      along[TriangleSplit::first_half(h)] = along[TriangleSplit::second_half(h)] = h;
    }
    sources.edges = edge_sources(after, mesh, along);
  }
  if (given.has(MeshElement::face))
    for (const FaceId f : faces(mesh)) sources.faces.insert(sources.faces.end(), 4, f.index());
  return provenance;
}

}  // namespace algebra3d::subdivision
