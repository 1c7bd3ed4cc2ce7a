// The attributes of an edited mesh.
#include <utility>

#include "algebra3d/kernel/halfedge/mesh_editor.h"

namespace algebra3d {

/// In the order of `mesh`.
ElementSources MeshEditor::sources(const PolygonMesh& source, const PolygonMesh& result) const {
  ElementSources sources;
  for (const Vertex& vertex : vertices_)
    if (vertex.is_used) sources.vertices.push_back(vertex.source);
  std::vector<std::uint32_t> along;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_[f].is_valid()) continue;
    sources.faces.push_back(face_sources_[f]);
    HalfedgeId h = faces_[f];
    do {
      sources.halfedges.push_back(halfedges_[h.index()].corner);
      along.push_back(halfedges_[h.index()].along);
      h = next(h);
    } while (h != faces_[f]);
  }
  sources.edges = edge_sources(result, source, along);
  return sources;
}

MeshAttributes MeshEditor::attributes(const MeshAttributes& given, const PolygonMesh& source,
                                      const PolygonMesh& result) const {
  if (given.is_empty()) return given;
  return taken_over_merged(given, source, result, sources(source, result), blends_);
}

}  // namespace algebra3d
