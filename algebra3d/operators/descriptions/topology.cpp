// isClosed, isManifold, isOriented, genus, eulerCharacteristic, boundaryLoops, valence, dual.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/real_sum.h"
#include "algebra3d/kernel/halfedge/dual.h"
#include "algebra3d/kernel/halfedge/shells.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/mesh_overloads.h"
#include "algebra3d/operators/descriptions/detail/mesh_rows.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::kFlatSquare;
using detail::kFoldedSurface;
using detail::kThreeAtAnEdge;
using detail::Number;

template <typename T>
bool is_value_closed(const T& value) {
  return is_closed(value.mesh());
}
template <typename T>
bool is_value_manifold(const T& value) {
  return is_manifold(value.mesh());
}
template <typename T>
bool is_value_oriented(const T& value) {
  return is_consistently_oriented(value.mesh());
}
template <typename T>
Maybe<Number> genus_of_value(const T& value) {
  return genus_of_shells(value.mesh());
}
template <typename T>
Number euler_characteristic_of_value(const T& value) {
  return euler_characteristic(value.mesh());
}

template <typename T>
Maybe<Number> valence_of(const T& value, const Number& vertex) {
  const Maybe<VertexId> v = detail::element<VertexId>("vertex", vertex, value.mesh().vertex_count());
  if (!v) return Undefined{v.reason()};
  return static_cast<Number>(valence(value.mesh(), *v));
}

template <typename T>
Result<Mesh3d> dual_of(Context& context, const T& value) {
  A3D_ASSIGN(PolygonMesh dual, dual_mesh(value.mesh(), context.monitor()));
  return Mesh3d(std::move(dual));
}

// ---- boundary loops

/// Id, Length, EdgeCount, Start, Position, Closed.
using LoopRows = Rows<Number, std::optional<double>, Number, Number, Point3d, bool>;

template <typename Layout>
std::optional<double> length_of(const HalfedgeMesh<Layout>& mesh, const BoundaryLoop& loop) {
  RealSum sum;
  for (const HalfedgeId h : loop.halfedges) {
    const double length = nearest_distance(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)));
    if (!std::isfinite(length)) return std::nullopt;
    sum.add(length);
  }
  return detail::number_if_finite(sum.total().nearest_double());
}

template <typename T>
LoopRows boundary_loops_of(const T& value) {
  const auto loops = std::make_shared<const std::vector<BoundaryLoop>>(boundary_loops(value.mesh()));
  return detail::rows_up_to<LoopRows>(loops->size(), [value, loops](std::size_t i) {
    const auto& mesh = value.mesh();
    const BoundaryLoop& loop = (*loops)[i];
    const VertexId start = mesh.origin(loop.halfedges.front());
    return LoopRows::Cells{static_cast<Number>(i),
                           length_of(mesh, loop),
                           static_cast<Number>(loop.halfedges.size()),
                           Number{start.index()},
                           Point3d{ExactPoint(mesh.point(start))},
                           loop.is_closed};
  });
}

// ---- descriptions

const std::string kQuadCube =
    "(mesh3d (((0 0 0) (3 0 0) (3 3 0) (0 3 0) (0 0 3) (3 0 3) (3 3 3) (0 3 3)) "
    "((0 3 2 1) (4 5 6 7) (0 1 5 4) (1 2 6 5) (2 3 7 6) (3 0 4 7))))";

constexpr const char* kExpected = ": expected (surface3d), (volume3d) or (mesh3d), got (point3d)";

void register_predicates(OperatorGroup& group) {
  group.add({
      .name = "isClosed",
      .syntax = "isClosed(_)",
      .doc = "True if no edge of a surface, solid or mesh has one face only.",
      .detail = "Solids and empty values are closed.",
      .exactness = Exactness::exact,
      .overloads =
          detail::mesh_overloads<&is_value_closed<Surface3d>, &is_value_closed<Volume3d>, &is_value_closed<Mesh3d>>(),
      .examples =
          {{{kUnitCube}, "TRUE"}, {{kQuadCube}, "TRUE"}, {{kFoldedSurface}, "FALSE"}, {{kUndefinedSolid}, "undefined"}},
      .errors = {{{kOrigin}, std::string("isClosed") + kExpected}},
  });
  group.add({
      .name = "isManifold",
      .syntax = "isManifold(_)",
      .doc = "True if every edge of a surface, solid or mesh has one face, or two that run along it in opposite "
             "directions, and the faces at each vertex are connected across such edges.",
      .detail = "Solids that touch themselves in an edge or vertex are not manifold.",
      .exactness = Exactness::exact,
      .overloads = detail::mesh_overloads<&is_value_manifold<Surface3d>, &is_value_manifold<Volume3d>,
                                          &is_value_manifold<Mesh3d>>(),
      .examples = {{{kUnitCube}, "TRUE"},
                   {{kFoldedSurface}, "TRUE"},
                   {{kThreeAtAnEdge}, "FALSE"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 1 0)) ((0 0 0) (-1 0 0) (0 -1 0))))"}, "FALSE"},
                   {{kUndefinedMesh}, "undefined"}},
      .errors = {{{kOrigin}, std::string("isManifold") + kExpected}},
  });
  group.add({
      .name = "isOriented",
      .syntax = "isOriented(_)",
      .doc = "True if at every edge of a surface, solid or mesh with more than one face as many faces run along it one "
             "way as the other.",
      .exactness = Exactness::exact,
      .overloads = detail::mesh_overloads<&is_value_oriented<Surface3d>, &is_value_oriented<Volume3d>,
                                          &is_value_oriented<Mesh3d>>(),
      .examples = {{{kUnitCube}, "TRUE"},
                   {{kFoldedSurface}, "TRUE"},
                   {{"(surface3d (((0 0 0) (2 0 0) (0 2 0)) ((0 0 0) (0 0 2) (0 2 0))))"}, "FALSE"},
                   {{kThreeAtAnEdge}, "FALSE"},
                   {{kUndefinedMesh}, "undefined"}},
      .errors = {{{kOrigin}, std::string("isOriented") + kExpected}},
  });
}

void register_numbers_of_topology(OperatorGroup& group) {
  group.add({
      .name = "genus",
      .syntax = "genus(_)",
      .doc = "The number of handles of a closed surface, solid or mesh: 0 of a ball, 1 of a ring.",
      .detail = "The sum over the shells, which are sets of faces that are connected across manifold edges; an edge or "
                "vertex that shells share is counted once for each of them. Undefined if a shell has a boundary, or "
                "meets itself in an edge or vertex.",
      .exactness = Exactness::exact,
      .overloads =
          detail::mesh_overloads<&genus_of_value<Surface3d>, &genus_of_value<Volume3d>, &genus_of_value<Mesh3d>>(),
      .examples = {{{kUnitCube}, "0"},
                   {{"(minus (createCube (makePoint3D 0 0 0) (makePoint3D 3 3 3)) (createCube (makePoint3D 1 1 -1) "
                     "(makePoint3D 2 2 4)))"},
                    "1"},
                   {{kQuadCube}, "0"},
                   {{kFlatSquare}, "undefined"},
                   {{kUndefinedMesh}, "undefined"}},
      .errors = {{{kOrigin}, std::string("genus") + kExpected}},
  });
  group.add({
      .name = "eulerCharacteristic",
      .syntax = "eulerCharacteristic(_)",
      .doc = "The number of vertices minus that of edges plus that of faces of a surface, solid or mesh.",
      .detail = "Vertices of no face do not count. Elements that parts share are counted once, so that two cubes with "
                "a common corner have 3.",
      .exactness = Exactness::exact,
      .overloads =
          detail::mesh_overloads<&euler_characteristic_of_value<Surface3d>, &euler_characteristic_of_value<Volume3d>,
                                 &euler_characteristic_of_value<Mesh3d>>(),
      .examples =
          {{{kUnitCube}, "2"}, {{kFoldedSurface}, "1"}, {{kThreeAtAnEdge}, "1"}, {{kUndefinedMesh}, "undefined"}},
      .errors = {{{kOrigin}, std::string("eulerCharacteristic") + kExpected}},
  });
  group.add({
      .name = "valence",
      .syntax = "valence(_, _)",
      .doc = "The number of edges at a vertex of a surface, solid or mesh.",
      .detail = "Vertices are numbered from 0, as by vertices. Undefined if there is none of this number.",
      .exactness = Exactness::exact,
      .overloads = detail::mesh_overloads<&valence_of<Surface3d>, &valence_of<Volume3d>, &valence_of<Mesh3d>>("vertex"),
      .examples = {{{kQuadCube, "7"}, "3"},
                   {{kThreeAtAnEdge, "0"}, "4"},
                   {{kFoldedSurface, "4"}, "undefined"},
                   {{kUndefinedMesh, "0"}, "undefined"}},
      .errors = {{{kQuadCube}, "valence: expected (surface3d int), (volume3d int) or (mesh3d int), got (mesh3d)"}},
  });
}

void register_boundary_loops(OperatorGroup& group) {
  group.add({
      .name = "boundaryLoops",
      .syntax = "boundaryLoops(_)",
      .doc = "The boundary loops of a surface or mesh, a row for each (Id: int, Length: real, EdgeCount: int, Start: "
             "int, Position: point3d, Closed: bool).",
      .detail = "A boundary loop is a chain of edges with one face each, with the faces to the left. Start is the "
                "vertex where it begins, Position its place. Closed is false for a chain that ends at edges with more "
                "than two faces. Parts that touch in a vertex have loops of their own. Loops are in the order of their "
                "first half-edges. Length is within 1 ulp. A solid has none.",
      .exactness = Exactness::two_ulp,
      .overloads =
          detail::mesh_tables<&boundary_loops_of<Surface3d>, &boundary_loops_of<Volume3d>, &boundary_loops_of<Mesh3d>>(
              {"Id", "Length", "EdgeCount", "Start", "Position", "Closed"}),
      .examples = {{{kFlatSquare}, "((0 8.0 4 0 (0.0 0.0 0.0) TRUE))"},
                   {{kThreeAtAnEdge}, "3", "(count _)"},
                   {{kUnitCube}, "()"},
                   {{kUndefinedMesh}, "()"}},
      .errors = {{{kOrigin}, std::string("boundaryLoops") + kExpected}},
  });
}

void register_dual(OperatorGroup& group) {
  group.add({
      .name = "dual",
      .syntax = "dual(_)",
      .doc = "The dual of a surface, solid or mesh: a vertex for each face, at the mean of its corners, and a face for "
             "each vertex with faces all around it.",
      .detail = "Vertex i of the dual stands for face i; faces are in the order of the vertices, with the same "
                "orientation. Vertices on a boundary or a non-manifold edge, and vertices of fewer than three faces, "
                "give no face; a vertex where parts touch gives one for each part that surrounds it. The coordinates "
                "are rounded once.",
      .exactness = Exactness::rounded_once,
      .overloads = detail::mesh_overloads<&dual_of<Surface3d>, &dual_of<Volume3d>, &dual_of<Mesh3d>>(),
      .examples = {{{kQuadCube},
                    "(((1.5 1.5 0.0) (1.5 1.5 3.0) (1.5 0.0 1.5) (3.0 1.5 1.5) (1.5 3.0 1.5) (0.0 1.5 1.5)) "
                    "((0 2 5) (0 3 2) (0 4 3) (0 5 4) (1 5 2) (1 2 3) (1 3 4) (1 4 5)))"},
                   {{kFlatSquare}, "(((1.0 1.0 0.0)) ())"},
                   {{kUndefinedMesh}, "undefined"}},
      .errors = {{{kOrigin}, std::string("dual") + kExpected}},
  });
}

}  // namespace

void register_topology(OperatorGroup& group) {
  register_predicates(group);
  register_numbers_of_topology(group);
  register_boundary_loops(group);
  register_dual(group);
}

}  // namespace algebra3d
