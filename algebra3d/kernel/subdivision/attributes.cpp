// Attributes after a step: linear interpolation, also where a scheme smooths the positions.
#include "algebra3d/kernel/subdivision/detail/attributes.h"
#include "base/interruption_scope.h"

#include <vector>

#include "algebra3d/kernel/halfedge/attribute_transfer.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/subdivision/detail/triangle_split.h"
#include "base/indices.h"

namespace algebra3d::subdivision {
namespace {

using Numbers = std::vector<std::uint32_t>;
using Terms = std::vector<ValueBlends::Term>;

/// Whether the values at the corners of a face are those of its vertices or of its corners.
enum class ValuesOf : std::uint8_t { vertices, corners };

std::uint32_t value_at(const PolygonMesh& mesh, HalfedgeId h, ValuesOf values) {
  return values == ValuesOf::vertices ? mesh.origin(h).index() : h.index();
}

/// The mean of the corners of a face.
std::uint32_t face_mean(const PolygonMesh& mesh, FaceId f, ValuesOf values, ValueBlends& blends) {
  Terms terms;
  for (const HalfedgeId h : halfedges_of(mesh, f)) terms.push_back({value_at(mesh, h, values), 1});
  return blends.add(terms);
}

/// The vertices of the mesh, then the middles of the edges.
Numbers vertices_and_middles(const PolygonMesh& mesh, ValueBlends& blends) {
  Numbers sources;
  for (const VertexId v : vertices(mesh)) sources.push_back(v.index());
  for (const HalfedgeId h : edges(mesh)) {
    poll_interruption_at(h.index());
    sources.push_back(blends.add_between(mesh.origin(h).index(), mesh.target(h).index(), 0.5));
  }
  return sources;
}

/// Per half-edge the middle of its corner and the next one.
Numbers corner_middles(const PolygonMesh& mesh, ValueBlends& blends) {
  Numbers middles;
  for (const HalfedgeId h : halfedges(mesh)) {
    poll_interruption_at(h.index());
    middles.push_back(blends.add_between(h.index(), mesh.next(h).index(), 0.5));
  }
  return middles;
}

/// Triangles into four, by TriangleSplit.
struct TriangleAttributes {
  static Numbers vertices(const PolygonMesh& mesh, const PolygonMesh& /*after*/, ValueBlends& blends) {
    return vertices_and_middles(mesh, blends);
  }
  static Numbers corners(const PolygonMesh& mesh, const PolygonMesh& after, ValueBlends& blends) {
    const Numbers middles = corner_middles(mesh, blends);
    Numbers sources(after.halfedge_count());
    for (const HalfedgeId id : halfedges(mesh)) {
      poll_interruption_at(id.index());
      const std::uint32_t h = id.index(), start = TriangleSplit::first_half(h);
      sources[start] = h;
      sources[start + 1] = sources[TriangleSplit::middle(h)] = middles[h];
      sources[start + 2] = middles[mesh.prev(id).index()];
    }
    return sources;
  }
  /// Per half-edge of the result the one that it is a half of.
  static Numbers along(const PolygonMesh& mesh, const PolygonMesh& after) {
    Numbers along(after.halfedge_count(), kNone);
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      poll_interruption_at(h);
      along[TriangleSplit::first_half(h)] = along[TriangleSplit::second_half(h)] = h;
    }
    return along;
  }
  static Numbers faces(const PolygonMesh& mesh, const PolygonMesh& /*after*/, ValueBlends& /*blends*/) {
    Numbers sources;
    for (const FaceId f : algebra3d::faces(mesh)) sources.insert(sources.end(), 4, f.index());
    return sources;
  }
};

/// A quadrilateral for each corner: corner, middle of its half-edge, middle of the face, middle of the one before.
struct CatmullClarkAttributes {
  static Numbers vertices(const PolygonMesh& mesh, const PolygonMesh& /*after*/, ValueBlends& blends) {
    Numbers sources = vertices_and_middles(mesh, blends);
    for (const FaceId f : algebra3d::faces(mesh)) sources.push_back(face_mean(mesh, f, ValuesOf::vertices, blends));
    return sources;
  }
  static Numbers corners(const PolygonMesh& mesh, const PolygonMesh& /*after*/, ValueBlends& blends) {
    const Numbers middles = corner_middles(mesh, blends);
    Numbers sources;
    for (const FaceId f : algebra3d::faces(mesh)) {
      poll_interruption_at(f.index());
      const std::uint32_t centre = face_mean(mesh, f, ValuesOf::corners, blends);
      for (const HalfedgeId h : halfedges_of(mesh, f))
        sources.insert(sources.end(), {h.index(), middles[h.index()], centre, middles[mesh.prev(h).index()]});
    }
    return sources;
  }
  static Numbers along(const PolygonMesh& mesh, const PolygonMesh& after) {
    Numbers along(after.halfedge_count(), kNone);
    for (const HalfedgeId h : halfedges(mesh)) {
      poll_interruption_at(h.index());
      const std::size_t start = std::size_t{4} * h.index();
      along[start] = h.index();
      along[start + 3] = mesh.prev(h).index();
    }
    return along;
  }
  static Numbers faces(const PolygonMesh& mesh, const PolygonMesh& /*after*/, ValueBlends& /*blends*/) {
    Numbers sources;
    for (const HalfedgeId h : halfedges(mesh)) sources.push_back(mesh.face(h).index());
    return sources;
  }
};

/// A vertex for each corner, in the middle of the corner, the middles of the edges beside it and that of the face. Of
/// the faces those of the mesh come first; those for edges and vertices are between several.
struct DooSabinAttributes {
  static Numbers new_vertices(const PolygonMesh& mesh, ValuesOf values, ValueBlends& blends) {
    Numbers sources;
    Terms terms;
    for (const HalfedgeId corner : halfedges(mesh)) {
      poll_interruption_at(corner.index());
      const double n = mesh.degree(mesh.face(corner));
      terms.clear();
      for (const HalfedgeId h : halfedges_of(mesh, mesh.face(corner))) {
        const bool is_beside = mesh.next(h) == corner || mesh.prev(h) == corner;
        terms.push_back({value_at(mesh, h, values), (h == corner ? 2 : is_beside ? 0.5 : 0) + 1 / n});
      }
      sources.push_back(blends.add(terms));
    }
    return sources;
  }
  static Numbers vertices(const PolygonMesh& mesh, const PolygonMesh& /*after*/, ValueBlends& blends) {
    return new_vertices(mesh, ValuesOf::vertices, blends);
  }
  static Numbers corners(const PolygonMesh& mesh, const PolygonMesh& after, ValueBlends& blends) {
    const Numbers at_vertices = new_vertices(mesh, ValuesOf::corners, blends);
    Numbers sources;
    for (const std::uint32_t vertex : after.origins()) sources.push_back(at_vertices[vertex]);
    return sources;
  }
  static Numbers along(const PolygonMesh& /*mesh*/, const PolygonMesh& after) {
    Numbers along(after.halfedge_count(), kNone);
    return along;
  }
  static Numbers faces(const PolygonMesh& mesh, const PolygonMesh& after, ValueBlends& blends) {
    Numbers sources;
    Terms terms;
    for (const FaceId f : algebra3d::faces(after)) {
      terms.clear();
      for (const VertexId v : vertices_of(after, f)) terms.push_back({mesh.face(HalfedgeId(v.index())).index(), 1});
      sources.push_back(f.index() < mesh.face_count() ? f.index() : blends.add(terms));
    }
    return sources;
  }
};

template <typename Scheme>
MeshAttributes attributes_after(const MeshAttributes& given, const PolygonMesh& before, const PolygonMesh& after) {
  ElementSources sources;
  ElementBlends blends(before);
  if (given.has(MeshElement::vertex)) sources.vertices = Scheme::vertices(before, after, blends.vertices);
  if (given.has(MeshElement::edge)) sources.edges = edge_sources(after, before, Scheme::along(before, after));
  if (given.has(MeshElement::halfedge)) sources.halfedges = Scheme::corners(before, after, blends.halfedges);
  if (given.has(MeshElement::face)) sources.faces = Scheme::faces(before, after, blends.faces);
  return taken_over(given, sources, blends);
}

}  // namespace

MeshAttributes attributes_after_step(const MeshAttributes& given, const PolygonMesh& before, const PolygonMesh& after,
                                     SubdivisionScheme scheme) {
  if (given.is_empty()) return given;
  switch (scheme) {
    case SubdivisionScheme::catmull_clark:
      return attributes_after<CatmullClarkAttributes>(given, before, after);
    case SubdivisionScheme::doo_sabin:
      return attributes_after<DooSabinAttributes>(given, before, after);
    case SubdivisionScheme::loop:
    case SubdivisionScheme::butterfly:
    case SubdivisionScheme::modified_butterfly:
      return attributes_after<TriangleAttributes>(given, before, after);
  }
  return {};
}

}  // namespace algebra3d::subdivision
