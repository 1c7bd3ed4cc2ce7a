#include "algebra3d/kernel/halfedge/adjacency.h"

#include <algorithm>
#include <unordered_set>

#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d {
namespace {

/// Leaves the first of equal elements.
template <typename Id>
void drop_repeated(std::vector<Id>& elements) {
  std::vector<Id> sorted = elements;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) == sorted.end()) return;
  std::unordered_set<Id> seen;
  std::erase_if(elements, [&](Id id) { return !seen.insert(id).second; });
}

/// Calls visit(h) with a half-edge of each edge at `v`; an edge that bounds two fans is visited for both.
template <typename Layout, typename Visit>
void for_each_edge_at(const HalfedgeMesh<Layout>& mesh, VertexId v, Visit visit) {
  for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
    visit(h);
    if (const HalfedgeId incoming = mesh.prev(h); !mesh.opposite(incoming).is_valid()) visit(incoming);
  }
}

template <typename Range>
auto unique_elements(const Range& range) {
  std::vector<std::ranges::range_value_t<Range>> elements;
  for (const auto element : range) elements.push_back(element);
  drop_repeated(elements);
  return elements;
}

}  // namespace

template <typename Layout>
std::vector<VertexId> vertices_beside(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  return unique_elements(adjacent_vertices(mesh, v));
}

template <typename Layout>
std::vector<HalfedgeId> edges_at(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  std::vector<HalfedgeId> edges;
  for_each_edge_at(mesh, v, [&](HalfedgeId h) { edges.push_back(first_along(mesh, h)); });
  drop_repeated(edges);
  return edges;
}

template <typename Layout>
std::vector<FaceId> faces_at(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  return unique_elements(faces_around(mesh, v));
}

template <typename Layout>
std::size_t valence(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  std::size_t count = 0;
  bool is_regular = true;
  for_each_edge_at(mesh, v, [&](HalfedgeId h) {
    ++count;
    is_regular = is_regular && !mesh.is_nonmanifold(h);
  });
  return is_regular ? count : edges_at(mesh, v).size();
}

template <typename Layout>
std::vector<VertexId> vertices_of_edge(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  std::vector<VertexId> ends{mesh.origin(edge), mesh.target(edge)};
  drop_repeated(ends);
  return ends;
}

template <typename Layout>
std::vector<HalfedgeId> edges_beside(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  std::vector<HalfedgeId> edges;
  for (const VertexId v : vertices_of_edge(mesh, edge))
    for_each_edge_at(mesh, v, [&](HalfedgeId h) { edges.push_back(first_along(mesh, h)); });
  std::erase(edges, edge);
  drop_repeated(edges);
  return edges;
}

template <typename Layout>
std::vector<FaceId> faces_along(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  std::vector<FaceId> faces{mesh.face(edge)};
  if (mesh.is_nonmanifold(edge))
    for (const HalfedgeId h : mesh.edge_halfedges(edge)) faces.push_back(mesh.face(h));
  else if (const HalfedgeId opposite = mesh.opposite(edge); opposite.is_valid())
    faces.push_back(mesh.face(opposite));
  drop_repeated(faces);
  return faces;
}

template <typename Layout>
std::vector<VertexId> vertices_of_face(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  return unique_elements(vertices_of(mesh, f));
}

template <typename Layout>
std::vector<HalfedgeId> edges_of_face(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  std::vector<HalfedgeId> edges;
  for (const HalfedgeId h : halfedges_of(mesh, f)) edges.push_back(first_along(mesh, h));
  drop_repeated(edges);
  return edges;
}

template <typename Layout>
std::vector<FaceId> faces_beside(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  return unique_elements(adjacent_faces(mesh, f));
}

// NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define ALGEBRA3D_INSTANTIATE(Layout)                                                       \
  template std::vector<VertexId> vertices_beside(const HalfedgeMesh<Layout>&, VertexId);    \
  template std::vector<HalfedgeId> edges_at(const HalfedgeMesh<Layout>&, VertexId);         \
  template std::vector<FaceId> faces_at(const HalfedgeMesh<Layout>&, VertexId);             \
  template std::size_t valence(const HalfedgeMesh<Layout>&, VertexId);                      \
  template std::vector<VertexId> vertices_of_edge(const HalfedgeMesh<Layout>&, HalfedgeId); \
  template std::vector<HalfedgeId> edges_beside(const HalfedgeMesh<Layout>&, HalfedgeId);   \
  template std::vector<FaceId> faces_along(const HalfedgeMesh<Layout>&, HalfedgeId);        \
  template std::vector<VertexId> vertices_of_face(const HalfedgeMesh<Layout>&, FaceId);     \
  template std::vector<HalfedgeId> edges_of_face(const HalfedgeMesh<Layout>&, FaceId);      \
  template std::vector<FaceId> faces_beside(const HalfedgeMesh<Layout>&, FaceId);
// NOLINTEND(cppcoreguidelines-macro-usage)
ALGEBRA3D_INSTANTIATE(TriangleLayout)
ALGEBRA3D_INSTANTIATE(PolygonLayout)
#undef ALGEBRA3D_INSTANTIATE

}  // namespace algebra3d
