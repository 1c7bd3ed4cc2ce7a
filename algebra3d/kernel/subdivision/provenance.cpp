#include "algebra3d/kernel/subdivision/detail/provenance.h"

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d::subdivision {

ValueSources vertices_and_middles(const PolygonMesh& mesh, ValueBlends& blends) {
  ValueSources sources;
  for (const VertexId v : vertices(mesh)) sources.push_back(v.index());
  for (const HalfedgeId h : edges(mesh)) {
    poll_interruption_at(h.index());
    sources.push_back(blends.add_between(mesh.origin(h).index(), mesh.target(h).index(), 0.5));
  }
  return sources;
}

ValueSources corner_middles(const PolygonMesh& mesh, ValueBlends& blends) {
  ValueSources middles;
  for (const HalfedgeId h : halfedges(mesh)) {
    poll_interruption_at(h.index());
    middles.push_back(blends.add_between(h.index(), mesh.next(h).index(), 0.5));
  }
  return middles;
}

std::uint32_t mean_of_vertices(const PolygonMesh& mesh, FaceId f, ValueBlends& blends) {
  std::vector<ValueBlends::Term> terms;
  for (const VertexId v : vertices_of(mesh, f)) terms.push_back({v.index(), 1});
  return blends.add(terms);
}

std::uint32_t mean_of_corners(const PolygonMesh& mesh, FaceId f, ValueBlends& blends) {
  std::vector<ValueBlends::Term> terms;
  for (const HalfedgeId h : halfedges_of(mesh, f)) terms.push_back({h.index(), 1});
  return blends.add(terms);
}

}  // namespace algebra3d::subdivision
