// The nine adjacency relations between vertices, edges and faces as tables: oneRing, vertexEdges, vertexFaces,
// edgeVertices, edgeEdges, edgeFaces, faceVertices, faceEdges, faceFaces; and half-edges by their number, at a vertex
// and of a face: halfedge, outgoingHalfedges, incomingHalfedges, faceHalfedges.
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/adjacency.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/mesh_overloads.h"
#include "algebra3d/operators/descriptions/detail/mesh_rows.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"

namespace algebra3d {
namespace {

using detail::kFlatSquare;
using detail::kFoldedSurface;
using detail::kThreeAtAnEdge;
using detail::Number;

// ---- make(element) for the element with a number

template <typename T, typename Make>
auto of_vertex(const T& value, Number number, Make make) -> Maybe<decltype(make(VertexId()))> {
  const Maybe<VertexId> v = detail::element<VertexId>("vertex", number, value.mesh().vertex_count());
  if (!v) return Undefined{v.reason()};
  return make(*v);
}
/// The edge is given to `make` by its first half-edge.
template <typename T, typename Make>
auto of_edge(const T& value, Number number, Make make) -> Maybe<decltype(make(HalfedgeId()))> {
  const EdgeNumbers& numbers = detail::edge_numbers_of(value);
  const Maybe<EdgeId> edge = detail::element<EdgeId>("edge", number, numbers.count());
  if (!edge) return Undefined{edge.reason()};
  return make(numbers.first_halfedge(*edge));
}
template <typename T, typename Make>
auto of_face(const T& value, Number number, Make make) -> Maybe<decltype(make(FaceId()))> {
  const Maybe<FaceId> f = detail::element<FaceId>("face", number, value.mesh().face_count());
  if (!f) return Undefined{f.reason()};
  return make(*f);
}

// ---- the relations

template <typename T>
Maybe<detail::VertexRows> vertex_vertices(const T& value, const Number& vertex) {
  return of_vertex(value, vertex,
                   [&](VertexId v) { return detail::vertex_rows(value, vertices_beside(value.mesh(), v)); });
}
template <typename T>
Maybe<detail::EdgeRows> vertex_edges(const T& value, const Number& vertex) {
  return of_vertex(value, vertex, [&](VertexId v) { return detail::edge_rows(value, edges_at(value.mesh(), v)); });
}
template <typename T>
Maybe<detail::FaceRows> vertex_faces(const T& value, const Number& vertex) {
  return of_vertex(value, vertex, [&](VertexId v) { return detail::face_rows(value, faces_at(value.mesh(), v)); });
}

template <typename T>
Maybe<detail::VertexRows> edge_vertices(const T& value, const Number& edge) {
  return of_edge(value, edge,
                 [&](HalfedgeId h) { return detail::vertex_rows(value, vertices_of_edge(value.mesh(), h)); });
}
template <typename T>
Maybe<detail::EdgeRows> edge_edges(const T& value, const Number& edge) {
  return of_edge(value, edge, [&](HalfedgeId h) { return detail::edge_rows(value, edges_beside(value.mesh(), h)); });
}
template <typename T>
Maybe<detail::FaceRows> edge_faces(const T& value, const Number& edge) {
  return of_edge(value, edge, [&](HalfedgeId h) { return detail::face_rows(value, faces_along(value.mesh(), h)); });
}

template <typename T>
Maybe<detail::VertexRows> face_vertices(const T& value, const Number& face) {
  return of_face(value, face, [&](FaceId f) { return detail::vertex_rows(value, vertices_of_face(value.mesh(), f)); });
}
template <typename T>
Maybe<detail::EdgeRows> face_edges(const T& value, const Number& face) {
  return of_face(value, face, [&](FaceId f) { return detail::edge_rows(value, edges_of_face(value.mesh(), f)); });
}
template <typename T>
Maybe<detail::FaceRows> face_faces(const T& value, const Number& face) {
  return of_face(value, face, [&](FaceId f) { return detail::face_rows(value, faces_beside(value.mesh(), f)); });
}

// ---- half-edges

template <typename T>
Maybe<detail::HalfedgeRows::Cells> halfedge_of_number(const T& value, const Number& number) {
  const Maybe<HalfedgeId> h = detail::element<HalfedgeId>("half-edge", number, value.mesh().halfedge_count());
  if (!h) return Undefined{h.reason()};
  return detail::halfedge_cells(value, *h);
}
template <typename T>
Maybe<detail::HalfedgeRows> vertex_outgoing(const T& value, const Number& vertex) {
  return of_vertex(value, vertex, [&](VertexId v) {
    std::vector<HalfedgeId> leaving;
    for (const HalfedgeId h : outgoing_halfedges(value.mesh(), v)) leaving.push_back(h);
    return detail::halfedge_rows(value, std::move(leaving));
  });
}
/// In each face the one before that which leaves.
template <typename T>
Maybe<detail::HalfedgeRows> vertex_incoming(const T& value, const Number& vertex) {
  return of_vertex(value, vertex, [&](VertexId v) {
    std::vector<HalfedgeId> arriving;
    for (const HalfedgeId h : outgoing_halfedges(value.mesh(), v)) arriving.push_back(value.mesh().prev(h));
    return detail::halfedge_rows(value, std::move(arriving));
  });
}
template <typename T>
Maybe<detail::HalfedgeRows> face_halfedges(const T& value, const Number& face) {
  return of_face(value, face, [&](FaceId f) {
    std::vector<HalfedgeId> around;
    for (const HalfedgeId h : halfedges_of(value.mesh(), f)) around.push_back(h);
    return detail::halfedge_rows(value, std::move(around));
  });
}

// ---- descriptions

template <auto OfSurface, auto OfSolid, auto OfMesh>
std::vector<Overload> giving_vertices(std::string_view parameter) {
  return detail::mesh_tables<OfSurface, OfSolid, OfMesh>(
      {"Id", "Position", "Valence", "Normal", "Boundary", "Manifold", "Halfedge"}, parameter);
}
template <auto OfSurface, auto OfSolid, auto OfMesh>
std::vector<Overload> giving_edges(std::string_view parameter) {
  return detail::mesh_tables<OfSurface, OfSolid, OfMesh>({"Id", "Start", "End", "Left", "Right", "Length", "Angle",
                                                          "Boundary", "Manifold", "FaceCount", "Halfedge", "Opposite"},
                                                         parameter);
}
template <auto OfSurface, auto OfSolid, auto OfMesh>
std::vector<Overload> giving_halfedges(std::string_view parameter) {
  return detail::mesh_tables<OfSurface, OfSolid, OfMesh>(
      {"Id", "Origin", "Target", "Next", "Previous", "Opposite", "Face", "Edge"}, parameter);
}
template <auto OfSurface, auto OfSolid, auto OfMesh>
std::vector<Overload> giving_faces(std::string_view parameter) {
  return detail::mesh_tables<OfSurface, OfSolid, OfMesh>({"Id", "Degree", "Area", "Normal", "Centroid", "Halfedge"},
                                                         parameter);
}

const std::string kVertexColumns =
    " (Id: int, Position: point3d, Valence: int, Normal: vector3d, Boundary: bool, Manifold: bool, Halfedge: int).";
const std::string kEdgeColumns =
    " (Id: int, Start: int, End: int, Left: int, Right: int, Length: real, Angle: real, Boundary: bool, Manifold: "
    "bool, FaceCount: int, Halfedge: int, Opposite: int).";
const std::string kFaceColumns =
    " (Id: int, Degree: int, Area: real, Normal: vector3d, Centroid: point3d, Halfedge: int).";
const std::string kHalfedgeColumns =
    " (Id: int, Origin: int, Target: int, Next: int, Previous: int, Opposite: int, Face: int, Edge: int).";
const std::string kOnce =
    " Each once, also where edges are not manifold. No rows, with a note, if there is no element with this number.";

/// The parts in which the descriptions of the relations differ.
struct Relation {
  std::string name, doc, columns_from, detail;
  std::vector<Overload> overloads;
  std::vector<Example> examples;
};

void add(OperatorGroup& group, Relation relation) {
  const bool gives_vertices = relation.columns_from == "vertices", gives_edges = relation.columns_from == "edges",
             gives_halfedges = relation.columns_from == "halfedges";
  group.add({
      .name = relation.name,
      .syntax = relation.name + "(_, _)",
      .doc = relation.doc + (gives_vertices    ? kVertexColumns
                             : gives_edges     ? kEdgeColumns
                             : gives_halfedges ? kHalfedgeColumns
                                               : kFaceColumns),
      .detail = "The columns are those of " + relation.columns_from + ". " + relation.detail + kOnce,
      .exactness = gives_vertices || gives_edges ? Exactness::bounded
                   : gives_halfedges             ? Exactness::exact
                                                 : Exactness::rounded_once,
      .overloads = std::move(relation.overloads),
      .examples = std::move(relation.examples),
      .errors = {{{kUnitCube}, relation.name + ": expected (surface3d int), (volume3d int) or (mesh3d int)"}},
  });
}

void register_of_vertices(OperatorGroup& group) {
  add(group,
      {"oneRing",
       "The one-ring of a vertex: the other ends of its edges",
       "vertices",
       "Counter-clockwise, fan by fan.",
       giving_vertices<&vertex_vertices<Surface3d>, &vertex_vertices<Volume3d>, &vertex_vertices<Mesh3d>>("vertex"),
       {{{kFlatSquare, "0"},
         "((1 (2.0 0.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 1) (3 (0.0 2.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 3))"},
        {{kThreeAtAnEdge, "0"}, "4", "(count _)"},
        {{kFlatSquare, "4"}, "()"},
        {{kUndefinedSolid, "0"}, "()"}}});
  add(group,
      {"vertexEdges",
       "The edges at a vertex",
       "edges",
       "Counter-clockwise, fan by fan.",
       giving_edges<&vertex_edges<Surface3d>, &vertex_edges<Volume3d>, &vertex_edges<Mesh3d>>("vertex"),
       {{{kFlatSquare, "0"},
         "((0 0 1 0 undefined 2.0 undefined TRUE FALSE 1 0 undefined) (3 3 0 0 undefined 2.0 undefined TRUE FALSE 1 3 "
         "undefined))"},
        {{kThreeAtAnEdge, "0"}, "4", "(count _)"},
        {{kFlatSquare, "-1"}, "()"},
        {{kUndefinedMesh, "0"}, "()"}}});
  add(group, {"vertexFaces",
              "The faces at a vertex",
              "faces, without Component",
              "Counter-clockwise, fan by fan.",
              giving_faces<&vertex_faces<Surface3d>, &vertex_faces<Volume3d>, &vertex_faces<Mesh3d>>("vertex"),
              {{{kFoldedSurface, "1"}, "((0 3 2.0 (0.0 0.0 1.0) (0.6666666666666666 0.6666666666666666 0.0) 0))"},
               {{kThreeAtAnEdge, "0"}, "3", "(count _)"},
               {{kFoldedSurface, "9"}, "()"},
               {{kUndefinedMesh, "0"}, "()"}}});
}

void register_of_edges(OperatorGroup& group) {
  add(group, {"edgeVertices",
              "The ends of an edge",
              "vertices",
              "Start, then End.",
              giving_vertices<&edge_vertices<Surface3d>, &edge_vertices<Volume3d>, &edge_vertices<Mesh3d>>("edge"),
              {{{kFlatSquare, "3"},
                "((3 (0.0 2.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 3) (0 (0.0 0.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 0))"},
               {{kFlatSquare, "4"}, "()"},
               {{kUndefinedMesh, "0"}, "()"}}});
  add(group,
      {"edgeEdges",
       "The edges that share an end with an edge",
       "edges",
       "First those at Start, then those at End.",
       giving_edges<&edge_edges<Surface3d>, &edge_edges<Volume3d>, &edge_edges<Mesh3d>>("edge"),
       {{{kFlatSquare, "0"},
         "((3 3 0 0 undefined 2.0 undefined TRUE FALSE 1 3 undefined) (1 1 2 0 undefined 2.0 undefined TRUE FALSE 1 1 "
         "undefined))"},
        {{kThreeAtAnEdge, "0"}, "6", "(count _)"},
        {{kFlatSquare, "4"}, "()"},
        {{kUndefinedMesh, "0"}, "()"}}});
  add(group, {"edgeFaces",
              "The faces along an edge",
              "faces, without Component",
              "In order of their numbers.",
              giving_faces<&edge_faces<Surface3d>, &edge_faces<Volume3d>, &edge_faces<Mesh3d>>("edge"),
              {{{kFlatSquare, "2"}, "((0 4 4.0 (0.0 0.0 1.0) (1.0 1.0 0.0) 0))"},
               {{kThreeAtAnEdge, "0"}, "3", "(count _)"},
               {{kFlatSquare, "4"}, "()"},
               {{kUndefinedMesh, "0"}, "()"}}});
}

void register_of_faces(OperatorGroup& group) {
  add(group, {"faceVertices",
              "The corners of a face",
              "vertices",
              "In order, from the first.",
              giving_vertices<&face_vertices<Surface3d>, &face_vertices<Volume3d>, &face_vertices<Mesh3d>>("face"),
              {{{"(surface3d (((0 0 0) (3 0 0) (0 3 0))))", "0"},
                "((0 (0.0 0.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 0) (1 (3.0 0.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 1) "
                "(2 (0.0 3.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 2))"},
               {{kFlatSquare, "1"}, "()"},
               {{kUndefinedMesh, "0"}, "()"}}});
  add(group, {"faceEdges",
              "The edges of a face",
              "edges",
              "In order, from the first corner.",
              giving_edges<&face_edges<Surface3d>, &face_edges<Volume3d>, &face_edges<Mesh3d>>("face"),
              {{{kFlatSquare, "0"}, "4", "(count _)"},
               {{kUnitCube, "11"}, "3", "(count _)"},
               {{kUnitCube, "12"}, "()"},
               {{kUndefinedMesh, "0"}, "()"}}});
  add(group, {"faceFaces",
              "The faces that share an edge with a face",
              "faces, without Component",
              "Edge by edge, from the first corner.",
              giving_faces<&face_faces<Surface3d>, &face_faces<Volume3d>, &face_faces<Mesh3d>>("face"),
              {{{kFoldedSurface, "0"}, "((1 3 2.0 (1.0 0.0 0.0) (0.0 0.6666666666666666 0.6666666666666666) 3))"},
               {{kThreeAtAnEdge, "1"}, "2", "(count _)"},
               {{kFlatSquare, "1"}, "()"},
               {{kUndefinedMesh, "0"}, "()"}}});
}

void register_halfedge_relations(OperatorGroup& group) {
  const std::string round = "Counter-clockwise, fan by fan; one for each corner at the vertex.";
  add(group,
      {"outgoingHalfedges",
       "The half-edges that leave a vertex",
       "halfedges",
       round,
       giving_halfedges<&vertex_outgoing<Surface3d>, &vertex_outgoing<Volume3d>, &vertex_outgoing<Mesh3d>>("vertex"),
       {{{kFoldedSurface, "0"}, "((0 0 1 1 2 undefined 0 0) (3 0 2 4 5 2 1 2))"},
        {{kThreeAtAnEdge, "0"}, "3", "(count _)"},
        {{kFlatSquare, "4"}, "()"},
        {{kUndefinedMesh, "0"}, "()"}}});
  add(group,
      {"incomingHalfedges",
       "The half-edges that arrive at a vertex",
       "halfedges",
       round,
       giving_halfedges<&vertex_incoming<Surface3d>, &vertex_incoming<Volume3d>, &vertex_incoming<Mesh3d>>("vertex"),
       {{{kFoldedSurface, "0"}, "((2 2 0 0 1 3 0 2) (5 3 0 3 4 undefined 1 4))"},
        {{kThreeAtAnEdge, "0"}, "3", "(count _)"},
        {{kFlatSquare, "4"}, "()"},
        {{kUndefinedMesh, "0"}, "()"}}});
  add(group, {"faceHalfedges",
              "The half-edges of a face",
              "halfedges",
              "In order, from the first corner.",
              giving_halfedges<&face_halfedges<Surface3d>, &face_halfedges<Volume3d>, &face_halfedges<Mesh3d>>("face"),
              {{{kFoldedSurface, "1"}, "((3 0 2 4 5 2 1 2) (4 2 3 5 3 undefined 1 3) (5 3 0 3 4 undefined 1 4))"},
               {{kFlatSquare, "0"}, "4", "(count _)"},
               {{kFlatSquare, "1"}, "()"},
               {{kUndefinedMesh, "0"}, "()"}}});
  add(group,
      {"halfedge",
       "The half-edge with a number",
       "halfedges",
       "One row.",
       giving_halfedges<&halfedge_of_number<Surface3d>, &halfedge_of_number<Volume3d>, &halfedge_of_number<Mesh3d>>(
           "number"),
       {{{kFoldedSurface, "3"}, "((3 0 2 4 5 2 1 2))"}, {{kUnitCube, "36"}, "()"}, {{kUndefinedMesh, "0"}, "()"}}});
}

}  // namespace

void register_mesh_neighbours(OperatorGroup& group) {
  register_of_vertices(group);
  register_of_edges(group);
  register_of_faces(group);
  register_halfedge_relations(group);
}

}  // namespace algebra3d
