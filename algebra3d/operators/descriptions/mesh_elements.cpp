// vertices, edges, halfedges, faces: the elements of a mesh as tables.
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/mesh_overloads.h"
#include "algebra3d/operators/descriptions/detail/mesh_rows.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::Number;

template <typename T>
detail::VertexRows vertices_of_value(const T& value) {
  return detail::rows_up_to<detail::VertexRows>(value.mesh().vertex_count(), [value](std::size_t i) {
    const VertexId v(i);
    return detail::vertex_cells(value.mesh(), v, facts_of(value.mesh(), v));
  });
}

/// The edges as they are met among the half-edges, so that their numbers need no table.
template <typename T>
detail::EdgeRows edges_of_value(const T& value) {
  using Next = Result<std::optional<detail::EdgeRows::Cells>>;
  return detail::EdgeRows([value, h = std::size_t{0}, edge = std::size_t{0}](Context& context) mutable -> Next {
    const auto& mesh = value.mesh();
    std::optional<detail::EdgeRows::Cells> row;
    for (; h < mesh.halfedge_count() && !row; ++h) {
      A3D_TRY(detail::check_sometimes(context, h));
      if (first_along(mesh, HalfedgeId(h)) == HalfedgeId(h))
        row = detail::edge_cells(mesh, EdgeId(edge++), HalfedgeId(h));
    }
    return row;
  });
}

template <typename T>
detail::HalfedgeRows halfedges_of_value(const T& value) {
  return detail::rows_up_to<detail::HalfedgeRows>(
      value.mesh().halfedge_count(), [value](std::size_t i) { return detail::halfedge_cells(value, HalfedgeId(i)); });
}

// ---- faces

/// Id, Degree, Area, Normal, Centroid, Halfedge, Component.
using FaceAndComponentRows =
    Rows<Number, Number, std::optional<double>, std::optional<Vector3d>, Point3d, Number, Number>;

/// The components of the faces, found when the first is asked for.
template <typename T>
class LazyComponents {
 public:
  Number of(const T& value, FaceId f) { return Number{value.geometry().components().of(f).index()}; }
};
template <>
class LazyComponents<Mesh3d> {
 public:
  Number of(const Mesh3d& value, FaceId f) {
    if (!components_) components_ = std::make_shared<const FaceComponents>(connected_components(value.mesh()));
    return Number{components_->of_face[f.index()]};
  }

 private:
  std::shared_ptr<const FaceComponents> components_;  // shared: function objects are copied
};

template <typename T>
FaceAndComponentRows faces_of_value(const T& value) {
  return detail::rows_up_to<FaceAndComponentRows>(
      value.mesh().face_count(), [value, components = LazyComponents<T>()](std::size_t i) mutable {
        const FaceId f(i);
        return std::tuple_cat(detail::face_cells(value.mesh(), f), std::tuple(components.of(value, f)));
      });
}

// ---- descriptions

using detail::kFlatSquare;
using detail::kFoldedSurface;
using detail::kThreeAtAnEdge;

constexpr const char* kNumbering =
    " Elements are numbered from 0 in the order of the value; rows are made one by one as they are read.";

void register_vertices(OperatorGroup& group) {
  group.add({
      .name = "vertices",
      .syntax = "vertices(_)",
      .doc = "The vertices of a surface, solid or mesh, a row for each (Id: int, Position: point3d, Valence: int, "
             "Normal: vector3d, Boundary: bool, Manifold: bool, Halfedge: int).",
      .detail =
          std::string("Valence is the number of edges at the vertex. Normal is the sum of the normals of its "
                      "faces, weighted by their angles there, scaled to length 1; undefined for a vertex of no "
                      "face and where they cancel. Its error is at most 10^-15 times the sum of the angles, "
                      "divided by the length of the sum. Boundary is true if an edge with one face ends there. "
                      "Manifold is false if the faces at the vertex are not all connected across manifold edges "
                      "there. Halfedge is one that leaves the vertex, at a boundary the first one there; undefined "
                      "for a vertex of no face.") +
          kNumbering,
      .exactness = Exactness::bounded,
      .sources = {"thuermer1998"},
      .overloads =
          detail::mesh_tables<&vertices_of_value<Surface3d>, &vertices_of_value<Volume3d>, &vertices_of_value<Mesh3d>>(
              {"Id", "Position", "Valence", "Normal", "Boundary", "Manifold", "Halfedge"}),
      .examples = {{{kFlatSquare},
                    "((0 (0.0 0.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 0) (1 (2.0 0.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 1) "
                    "(2 (2.0 2.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 2) (3 (0.0 2.0 0.0) 2 (0.0 0.0 1.0) TRUE TRUE 3))"},
                   {{kUnitCube}, "8", "(count _)"},
                   {{kFoldedSurface}, "4", "(count _)"},
                   {{kUndefinedSolid}, "()"}},
      .errors = {{{kOrigin}, "vertices: expected (surface3d), (volume3d) or (mesh3d), got (point3d)"}},
  });
}

void register_edges(OperatorGroup& group) {
  group.add({
      .name = "edges",
      .syntax = "edges(_)",
      .doc = "The edges of a surface, solid or mesh, a row for each (Id: int, Start: int, End: int, Left: int, Right: "
             "int, Length: real, Angle: real, Boundary: bool, Manifold: bool, FaceCount: int, Halfedge: int, Opposite: "
             "int).",
      .detail =
          std::string("Start and End are vertices, Left the first face along the edge, which has it from Start to "
                      "End, Right the other face of a manifold edge. Angle, in degrees, is that between the "
                      "normals of the two faces: 0 flat, positive convex, negative concave; within 10^-12 "
                      "degrees. Boundary edges have one face; an edge that is neither boundary nor Manifold has "
                      "more than two, two that run along it in the same direction, or one that has it twice in one. A "
                      "bridge, which one face has in both directions, is Manifold; FaceCount is the number of "
                      "different faces, those of edgeFaces, so it is 1 there. Right and Angle are undefined where the "
                      "edge is not manifold. Length is rounded once. Halfedge is the first half-edge along the edge, "
                      "from Start "
                      "to End, Opposite the other one of a manifold edge.") +
          kNumbering,
      .exactness = Exactness::bounded,
      .overloads = detail::mesh_tables<&edges_of_value<Surface3d>, &edges_of_value<Volume3d>, &edges_of_value<Mesh3d>>(
          {"Id", "Start", "End", "Left", "Right", "Length", "Angle", "Boundary", "Manifold", "FaceCount", "Halfedge",
           "Opposite"}),
      .examples =
          {{{kFoldedSurface},
            "((0 0 1 0 undefined 2.0 undefined TRUE FALSE 1 0 undefined) (1 1 2 0 undefined 2.8284271247461903 "
            "undefined TRUE FALSE 1 1 undefined) (2 2 0 0 1 2.0 -90.0 FALSE TRUE 2 2 3) (3 2 3 1 undefined "
            "2.8284271247461903 undefined TRUE FALSE 1 4 undefined) (4 3 0 1 undefined 2.0 undefined TRUE FALSE "
            "1 5 undefined))"},
           {{kUnitCube}, "18", "(count _)"},
           {{kThreeAtAnEdge}, "7", "(count _)"},
           {{kUndefinedMesh}, "()"}},
      .errors = {{{kOrigin}, "edges: expected (surface3d), (volume3d) or (mesh3d), got (point3d)"}},
  });
}

void register_halfedges(OperatorGroup& group) {
  group.add({
      .name = "halfedges",
      .syntax = "halfedges(_)",
      .doc =
          "The half-edges of a surface, solid or mesh, a row for each (Id: int, Origin: int, Target: int, Next: int, "
          "Previous: int, Opposite: int, Face: int, Edge: int).",
      .detail = std::string("A half-edge is one side of a face, from the vertex Origin to the vertex Target; Next "
                            "follows it round the face, and Previous comes before it. Opposite is the other half-edge "
                            "of a manifold edge, undefined "
                            "at other edges.") +
                kNumbering,
      .exactness = Exactness::exact,
      .sources = {"campagna1998"},
      .overloads = detail::mesh_tables<&halfedges_of_value<Surface3d>, &halfedges_of_value<Volume3d>,
                                       &halfedges_of_value<Mesh3d>>(
          {"Id", "Origin", "Target", "Next", "Previous", "Opposite", "Face", "Edge"}),
      .examples = {{{kFoldedSurface},
                    "((0 0 1 1 2 undefined 0 0) (1 1 2 2 0 undefined 0 1) (2 2 0 0 1 3 0 2) (3 0 2 4 5 2 1 2) "
                    "(4 2 3 5 3 undefined 1 3) (5 3 0 3 4 undefined 1 4))"},
                   {{kUnitCube}, "36", "(count _)"},
                   {{kFlatSquare}, "4", "(count _)"},
                   {{kUndefinedMesh}, "()"}},
      .errors = {{{kOrigin}, "halfedges: expected (surface3d), (volume3d) or (mesh3d), got (point3d)"}},
  });
}

void register_faces(OperatorGroup& group) {
  group.add({
      .name = "faces",
      .syntax = "faces(_)",
      .doc =
          "The faces of a surface, solid or mesh, a row for each (Id: int, Degree: int, Area: real, Normal: vector3d, "
          "Centroid: point3d, Halfedge: int, Component: int).",
      .detail =
          std::string("Degree is the number of corners, Normal has length 1 and points to the side from which the "
                      "corners run counter-clockwise; undefined for a face without area. Area and Normal of a "
                      "bent polygon are those of its projection along Normal. Centroid is the mean of the "
                      "corners. Halfedge is the first one of the face. Component is the number, from 0, of the set of "
                      "faces that are connected across "
                      "edges. All numbers are rounded once, so parallel faces have equal normals.") +
          kNumbering,
      .exactness = Exactness::rounded_once,
      .sources = {"newell1972"},
      .overloads = detail::mesh_tables<&faces_of_value<Surface3d>, &faces_of_value<Volume3d>, &faces_of_value<Mesh3d>>(
          {"Id", "Degree", "Area", "Normal", "Centroid", "Halfedge", "Component"}),
      .examples = {{{kFlatSquare}, "((0 4 4.0 (0.0 0.0 1.0) (1.0 1.0 0.0) 0 0))"},
                   {{"(surface3d (((0 0 0) (3 0 0) (0 3 0)) ((5 0 0) (5 3 0) (5 0 3))))"},
                    "((0 3 4.5 (0.0 0.0 1.0) (1.0 1.0 0.0) 0 0) (1 3 4.5 (1.0 0.0 0.0) (5.0 1.0 1.0) 3 1))"},
                   {{kUnitCube}, "12", "(count _)"},
                   {{kUndefinedSolid}, "()"}},
      .errors = {{{kOrigin}, "faces: expected (surface3d), (volume3d) or (mesh3d), got (point3d)"}},
  });
}

}  // namespace

void register_mesh_elements(OperatorGroup& group) {
  register_vertices(group);
  register_edges(group);
  register_halfedges(group);
  register_faces(group);
}

}  // namespace algebra3d
