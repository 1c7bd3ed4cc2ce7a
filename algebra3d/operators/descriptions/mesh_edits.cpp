// flipEdge, splitEdge, collapseEdge, splitFace, splitVertex, moveVertex.
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/mesh_editor.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/number_text.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Outcome3d = Result<Maybe<Mesh3d>>;

/// The elements of a kind by their numbers: "edges 0 to 17".
std::string numbered(const std::string& kind, std::size_t count) {
  if (count == 0) return "no " + kind;
  if (count == 1) return "only " + kind + " 0";
  return fmt::format("{} 0 to {}", kind == "vertex" ? "vertices" : kind + "s", count - 1);
}

Error no_element(const char* name, const char* kind, std::int64_t id, std::size_t count) {
  return {ErrorCode::invalid_value, "{}: there is no {} {}; the mesh has {}", name, kind, id, numbered(kind, count)};
}

bool is_below(std::int64_t id, std::size_t count) {
  return id >= 0 && static_cast<std::uint64_t>(id) < count;
}

Result<VertexId> vertex_of(const char* name, const PolygonMesh& mesh, std::int64_t id) {
  if (!is_below(id, mesh.vertex_count())) return no_element(name, "vertex", id, mesh.vertex_count());
  return VertexId(static_cast<std::size_t>(id));
}

Result<FaceId> face_of(const char* name, const PolygonMesh& mesh, std::int64_t id) {
  if (!is_below(id, mesh.face_count())) return no_element(name, "face", id, mesh.face_count());
  return FaceId(static_cast<std::size_t>(id));
}

/// The first half-edge of the edge with a number.
Result<HalfedgeId> edge_of(const char* name, const Mesh3d& mesh, std::int64_t id) {
  const EdgeNumbers& numbers = mesh.edge_numbers();
  if (!is_below(id, numbers.count())) return no_element(name, "edge", id, numbers.count());
  return numbers.first_halfedge(EdgeId(static_cast<std::size_t>(id)));
}

/// Applies `edit`, which returns a Maybe, to an editor of the mesh. Errors: interrupted.
template <typename Edit>
Outcome3d edited(Context& context, const Mesh3d& mesh, const Edit& edit) {
  Maybe<MeshEditor> editor = MeshEditor::of(mesh.mesh());
  if (!editor) return Maybe<Mesh3d>(Undefined{editor.reason()});
  A3D_TRY(context.check_cancelled());
  if (auto done = edit(*editor); !done) return Maybe<Mesh3d>(Undefined{done.reason()});
  PolygonMesh result = editor->mesh();
  A3D_TRY(context.check_cancelled());
  MeshAttributes attributes = editor->attributes(mesh.attributes(), mesh.mesh(), result);
  return Maybe<Mesh3d>(Mesh3d(std::move(result), std::move(attributes)));
}

Outcome3d with_flipped_edge(Context& context, const Mesh3d& mesh, std::int64_t edge) {
  A3D_ASSIGN(const HalfedgeId h, edge_of("flipEdge", mesh, edge));
  return edited(context, mesh, [h](MeshEditor& editor) { return editor.flip_edge(h); });
}

Outcome3d with_edge_split_at(Context& context, const Mesh3d& mesh, std::int64_t edge, const Point3d& point) {
  A3D_ASSIGN(const HalfedgeId h, edge_of("splitEdge", mesh, edge));
  return edited(context, mesh,
                [&](MeshEditor& editor) { return Maybe<VertexId>(editor.split_edge(h, point.position)); });
}

Outcome3d with_split_edge(Context& context, const Mesh3d& mesh, std::int64_t edge, double share) {
  A3D_ASSIGN(const HalfedgeId h, edge_of("splitEdge", mesh, edge));
  if (!(share > 0 && share < 1))
    return Maybe<Mesh3d>(Undefined{"the share must be greater than 0 and less than 1, got " + real_text(share)});
  const RationalVec3 from = mesh.mesh().point(mesh.mesh().origin(h)).rational();
  const RationalVec3 to = mesh.mesh().point(mesh.mesh().target(h)).rational();
  const Rational t(share);
  const auto between = [&](std::size_t axis) { return from[axis] + t * (to[axis] - from[axis]); };
  const ExactPoint point(RationalVec3{between(0), between(1), between(2)});
  return edited(context, mesh, [&](MeshEditor& editor) { return Maybe<VertexId>(editor.split_edge(h, point, share)); });
}

Outcome3d with_collapsed_edge(Context& context, const Mesh3d& mesh, std::int64_t edge) {
  A3D_ASSIGN(const HalfedgeId h, edge_of("collapseEdge", mesh, edge));
  return edited(context, mesh, [h](MeshEditor& editor) { return editor.collapse_edge(h); });
}

Outcome3d with_split_face(Context& context, const Mesh3d& mesh, std::int64_t face, std::int64_t from, std::int64_t to) {
  A3D_ASSIGN(const FaceId f, face_of("splitFace", mesh.mesh(), face));
  A3D_ASSIGN(const VertexId first, vertex_of("splitFace", mesh.mesh(), from));
  A3D_ASSIGN(const VertexId second, vertex_of("splitFace", mesh.mesh(), to));
  return edited(context, mesh, [&](MeshEditor& editor) { return editor.split_face(f, first, second); });
}

Outcome3d with_face_split_at(Context& context, const Mesh3d& mesh, std::int64_t face, const Point3d& point) {
  A3D_ASSIGN(const FaceId f, face_of("splitFace", mesh.mesh(), face));
  return edited(context, mesh, [&](MeshEditor& editor) { return editor.split_face(f, point.position); });
}

Outcome3d with_split_vertex(Context& context, const Mesh3d& mesh, std::int64_t vertex, std::int64_t first,
                            std::int64_t last, const Point3d& point) {
  A3D_ASSIGN(const VertexId v, vertex_of("splitVertex", mesh.mesh(), vertex));
  A3D_ASSIGN(const VertexId from, vertex_of("splitVertex", mesh.mesh(), first));
  A3D_ASSIGN(const VertexId to, vertex_of("splitVertex", mesh.mesh(), last));
  return edited(context, mesh, [&](MeshEditor& editor) -> Maybe<VertexId> {
    const HalfedgeId begin = editor.find(v, from), end = editor.find(v, to);
    for (const auto& [h, neighbour] : {std::pair(begin, from), std::pair(end, to)})
      if (!h.is_valid())
        return Undefined{fmt::format("no edge joins vertices {} and {}", v.index(), neighbour.index())};
    return editor.split_vertex(v, begin, end, point.position);
  });
}

Outcome3d with_moved_vertex(Context& /*context*/, const Mesh3d& mesh, std::int64_t vertex, const Point3d& point) {
  A3D_ASSIGN(const VertexId v, vertex_of("moveVertex", mesh.mesh(), vertex));
  PointArray points;
  points.reserve(mesh.mesh().vertex_count());
  points.append(mesh.mesh().points(), 0, v.index());
  points.push_back(point.position);
  points.append(mesh.mesh().points(), v.index() + 1, mesh.mesh().vertex_count() - v.index() - 1);
  PolygonMesh moved(std::move(points), mesh.mesh().layout(), mesh.mesh().origins());
  return Maybe<Mesh3d>(Mesh3d(std::move(moved), mesh.attributes()));
}

const std::string kHalvedSquare = "(mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2) (0 2 3))))";
const std::string kSquareFace = "(mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2 3))))";
const std::string kUnitTetrahedron = "(mesh3d (((0 0 0) (1 0 0) (0 1 0) (0 0 1)) ((0 2 1) (0 1 3) (1 2 3) (2 0 3))))";
const std::string kThreeTriangles = "(mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0) (1 2 0)) ((0 1 2) (0 2 3) (3 2 4))))";
/// The common part of the descriptions of edits that keep the topology.
const std::string kCommonDetail =
    "The mesh must be a manifold, boundary allowed; otherwise, and where the edit would not leave one, the result is "
    "undefined, with the reason. Coordinates are exact and do not matter. Edges are numbered from 0 by their first "
    "half-edges, as edges lists them. Attributes are kept. ";

void register_edge_edits(OperatorGroup& group) {
  group.add({
      .name = "flipEdge",
      .syntax = "flipEdge(_, _)",
      .doc = "The mesh with one edge turned, so that it joins the next corners of the two faces beside it.",
      .detail =
          kCommonDetail +
          "Of two triangles it becomes the other diagonal. Vertices and faces keep their numbers. Refused at the "
          "boundary, where an edge joins those corners already, and where a vertex would be left with one edge. At "
          "its new corner a face has the values of the other face there.",
      .exactness = Exactness::exact,
      .overloads = {overload<&with_flipped_edge>("mesh", "edge")},
      .examples = {{{kHalvedSquare, "2"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((3 1 2) (1 3 0)))"},
                   {{kHalvedSquare, "0"}, "undefined"},
                   {{kUnitTetrahedron, "0"}, "undefined"},
                   {{kUndefinedMesh, "0"}, "undefined"}},
      .errors = {{{kHalvedSquare, "5"}, "flipEdge: there is no edge 5; the mesh has edges 0 to 4"},
                 {{"1", "0"}, "flipEdge: expected (mesh3d int)"}},
  });
  group.add({
      .name = "splitEdge",
      .syntax = "splitEdge(_, _, _)",
      .doc = "The mesh with a new vertex in an edge: at a share of the way along it, or at a point.",
      .detail =
          kCommonDetail +
          "Triangles along the edge are divided, faces of more corners get one more. The new vertex is the last "
          "one, and new faces come last. A share counts from the origin of the edge's first half-edge and must "
          "be between 0 and 1; the point is exact. A point need not be on the edge. Both parts of the edge and of a "
          "face have its values. The values of the vertex and of its corners are between those at the ends, "
          "numbers by the share of the way (of the nearest place on the edge for a point), texts only if they "
          "agree.",
      .exactness = Exactness::exact,
      .overloads = {overload<&with_split_edge>("mesh", "edge", "share"),
                    overload<&with_edge_split_at>("mesh", "edge", "point")},
      .examples = {{{kSquareFace, "0", "0.5"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0) (0.5 0.0 0.0)) ((0 4 1 2 3)))"},
                   {{kSquareFace, "0", "1.0"}, "undefined"},
                   {{kUndefinedMesh, "0", "0.5"}, "undefined"},
                   {{kUndefinedMesh, "0", kOrigin}, "undefined"}},
      .errors = {{{kSquareFace, "-1", "0.5"}, "splitEdge: there is no edge -1; the mesh has edges 0 to 3"},
                 {{kSquareFace, "4", kOrigin}, "splitEdge: there is no edge 4; the mesh has edges 0 to 3"},
                 {{"1", "0", "0.5"}, "splitEdge: expected (mesh3d int real) or (mesh3d int point3d)"}},
  });
  group.add({
      .name = "collapseEdge",
      .syntax = "collapseEdge(_, _)",
      .doc = "The mesh with the two ends of an edge merged into the first one, which stays where it is.",
      .detail =
          kCommonDetail +
          "The origin of the edge's first half-edge stays; triangles along the edge vanish. Vertices and faces "
          "after those that are gone move down in number. Refused unless the link condition holds: the ends have "
          "no common neighbours but the third corners of triangles along the edge, and an edge inside does not "
          "join boundary to boundary. Corners that change to the vertex that stays take its values in their chart, "
          "that is, on their side of all edges where the values of corners differ.",
      .exactness = Exactness::exact,
      .sources = {"dey1999"},
      .overloads = {overload<&with_collapsed_edge>("mesh", "edge")},
      .examples = {{{kThreeTriangles, "4"},
                    "(((1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0) (1.0 2.0 0.0)) ((2 0 1) (2 1 3)))"},
                   {{kHalvedSquare, "2"}, "undefined"},
                   {{kUnitTetrahedron, "0"}, "undefined"},
                   {{kUndefinedMesh, "0"}, "undefined"}},
      .errors = {{{kUnitTetrahedron, "6"}, "collapseEdge: there is no edge 6; the mesh has edges 0 to 5"},
                 {{"1", "0"}, "collapseEdge: expected (mesh3d int)"}},
  });
}

void register_other_edits(OperatorGroup& group) {
  group.add({
      .name = "splitFace",
      .syntax = "splitFace(_, _ ...)",
      .doc =
          "The mesh with a face divided: by an edge that joins two of its corners, or by a new vertex at a point that "
          "is joined to all of them.",
      .detail =
          kCommonDetail +
          "By an edge: the part from the first corner to the second, in the order of the face, keeps the number; "
          "the other one is the last face. Refused where the corners are neighbours, or joined by an edge "
          "elsewhere. By a vertex: a face of n corners becomes n triangles; the one at its first edge keeps the "
          "number, the others are the last faces, and the vertex is the last one; the point need not be on the "
          "face. Refused if a vertex is two corners of the face. All parts have the values of the face. The values "
          "of the vertex and of its corners are means of those of the corners of the face: numbers by the mean "
          "value coordinates of the point, in a triangle its barycentric ones, texts only if all agree.",
      .exactness = Exactness::exact,
      .sources = {"floater2003"},
      .overloads = {overload<&with_split_face>("mesh", "face", "first", "second"),
                    overload<&with_face_split_at>("mesh", "face", "point")},
      .examples = {{{kSquareFace, "0", "0", "2"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2) (2 3 0)))"},
                   {{kSquareFace, "0", "(makePoint3D 0.5 0.5 1)"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0) (0.5 0.5 1.0)) ((0 1 4) (1 2 4) (2 3 4) "
                    "(3 0 4)))"},
                   {{kSquareFace, "0", "0", "1"}, "undefined"},
                   {{kUndefinedMesh, "0", kOrigin}, "undefined"},
                   {{kUndefinedMesh, "0", "0", "2"}, "undefined"}},
      .errors = {{{kSquareFace, "1", "0", "2"}, "splitFace: there is no face 1; the mesh has only face 0"},
                 {{kSquareFace, "-1", kOrigin}, "splitFace: there is no face -1; the mesh has only face 0"},
                 {{kSquareFace, "0", "4", "2"}, "splitFace: there is no vertex 4; the mesh has vertices 0 to 3"},
                 {{"1", "0", "0", "2"}, "splitFace: expected (mesh3d int int int) or (mesh3d int point3d)"}},
  });
  group.add({
      .name = "splitVertex",
      .syntax = "splitVertex(_, _, _, _, _)",
      .doc = "The mesh with a vertex divided in two that an edge joins; the new one is at a point.",
      .detail =
          kCommonDetail +
          "Counter-clockwise about the vertex, the edges from the one to the first neighbour up to the one to "
          "the second, without it, move to the new vertex, which is the last one. Triangles to the right of these two "
          "edges become two, so that both vertices are joined to both neighbours, and a mesh of triangles stays one; "
          "new faces come last. Faces of more corners get one more. The new vertex and its corners have the values of "
          "the vertex. Refused unless both are neighbours, and two. This reverses collapseEdge.",
      .exactness = Exactness::exact,
      .overloads = {overload<&with_split_vertex>("mesh", "vertex", "first", "second", "point")},
      .examples =
          {{{kHalvedSquare, "2", "3", "0", "(makePoint3D 0.5 1 0)"},
            "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0) (0.5 1.0 0.0)) ((0 1 2) (0 2 4) (4 3 0)))"},
           {{kHalvedSquare, "1", "3", "0", kOrigin}, "undefined"},
           {{kUndefinedMesh, "0", "1", "2", kOrigin}, "undefined"}},
      .errors = {{{kHalvedSquare, "4", "3", "0", kOrigin},
                  "splitVertex: there is no vertex 4; the mesh has vertices 0 to 3"},
                 {{"1", "0", "0", "2", kOrigin}, "splitVertex: expected (mesh3d int int int point3d)"}},
  });
  group.add({
      .name = "moveVertex",
      .syntax = "moveVertex(_, _, _)",
      .doc = "The mesh with one vertex at another point.",
      .detail = "Works on every mesh. Nothing else changes; faces of four or more corners may "
                "become bent.",
      .exactness = Exactness::exact,
      .overloads = {overload<&with_moved_vertex>("mesh", "vertex", "point")},
      .examples = {{{kSquareFace, "1", "(makePoint3D 2 0 0)"},
                    "(((0.0 0.0 0.0) (2.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2 3)))"},
                   {{kUndefinedMesh, "1", kOrigin}, "undefined"}},
      .errors = {{{kSquareFace, "7", kOrigin}, "moveVertex: there is no vertex 7; the mesh has vertices 0 to 3"},
                 {{"1", "0", kOrigin}, "moveVertex: expected (mesh3d int point3d)"}},
  });
}

}  // namespace

void register_mesh_edits(OperatorGroup& group) {
  register_edge_edits(group);
  register_other_edits(group);
}

}  // namespace algebra3d
