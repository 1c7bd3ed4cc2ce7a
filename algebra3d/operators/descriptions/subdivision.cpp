// subdivide, limitPosition.
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/subdivision/divided_contacts.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Error named(const char* name, Error error) {
  return std::move(error).about(name);
}

/// The faces to subdivide, and whether they were divided where they touch.
struct SubdivisionInput {
  PolygonMesh mesh;
  bool is_divided = false;
};

Result<SubdivisionInput> input_of(Context& /*context*/, const char* /*name*/, const Mesh3d& mesh) {
  return SubdivisionInput{mesh.mesh()};
}

std::string counted_nouns(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

template <typename T>
PolygonMesh linked_triangles(const T& geometry) {
  return {geometry.mesh().points(), PolygonLayout::of_degree(3), geometry.mesh().origins()};
}

/// The triangles as they are; where they touch in edges or vertices they are divided, with a note.
template <typename T>
Result<SubdivisionInput> input_of(Context& context, const char* name, const T& geometry) {
  PolygonMesh mesh = linked_triangles(geometry);
  if (is_manifold(mesh)) return SubdivisionInput{std::move(mesh)};
  constexpr bool kIsSolid = std::is_same_v<T, Volume3d>;
  auto divided = divided_contacts(mesh, kIsSolid ? ContactsOf::solids : ContactsOf::surfaces);
  if (!divided.ok()) return named(name, divided.error());
  context.diagnostics.report(fmt::format(
      "{}: divided the {} at {} and {}, where {}", name, kIsSolid ? "solid" : "surface",
      counted_nouns(divided->edge_count, "edge", "edges"), counted_nouns(divided->vertex_count, "vertex", "vertices"),
      kIsSolid ? "bodies touch" : "it is not manifold"));
  return SubdivisionInput{std::move(divided->mesh), true};
}

Mesh3d unchanged(const Mesh3d& mesh) {
  return mesh;
}
template <typename T>
Mesh3d unchanged(const T& geometry) {
  return Mesh3d(linked_triangles(geometry));
}

const MeshAttributes& attributes_of_input(const Mesh3d& mesh) {
  return mesh.attributes();
}
template <typename T>
MeshAttributes attributes_of_input(const T& /*geometry*/) {
  return {};
}

Result<SubdivisionScheme> scheme_of(const char* name, const std::string& text) {
  if (const auto scheme = subdivision_scheme(text)) return *scheme;
  return Error{ErrorCode::invalid_value, R"({}: unknown scheme "{}", expected one of {})", name, text,
               subdivision_scheme_names()};
}

Result<SubdivisionOptions> options_of(const char* name, const SubdivisionScheme& scheme, const std::string& variant) {
  const Result<std::size_t> known = subdivision_variant(scheme, variant);
  if (!known.ok()) return named(name, known.error());
  return SubdivisionOptions{*known};
}

template <typename T>
Result<Maybe<Mesh3d>> after_steps(Context& context, const T& geometry, const SubdivisionScheme& scheme,
                                  std::int64_t steps, const SubdivisionOptions& options) {
  if (steps < 0) return Maybe<Mesh3d>(Undefined{"the number of steps is negative"});
  if (steps == 0) return Maybe<Mesh3d>(unchanged(geometry));
  A3D_ASSIGN(const SubdivisionInput input, input_of(context, "subdivide", geometry));
  auto result = subdivided(input.mesh, attributes_of_input(geometry), scheme, static_cast<std::size_t>(steps), options,
                           context.monitor());
  if (!result.ok()) return named("subdivide", result.error());
  return Maybe<Mesh3d>(Mesh3d(std::move(result->mesh), std::move(result->attributes)));
}

template <typename T>
Result<Maybe<Mesh3d>> subdivided_mesh(Context& context, const T& geometry, const std::string& scheme_name,
                                      std::int64_t steps) {
  A3D_ASSIGN(const SubdivisionScheme scheme, scheme_of("subdivide", scheme_name));
  return after_steps(context, geometry, scheme, steps, {});
}

template <typename T>
Result<Maybe<Mesh3d>> subdivided_by_variant(Context& context, const T& geometry, const std::string& scheme_name,
                                            std::int64_t steps, const std::string& variant) {
  A3D_ASSIGN(const SubdivisionScheme scheme, scheme_of("subdivide", scheme_name));
  A3D_ASSIGN(const SubdivisionOptions options, options_of("subdivide", scheme, variant));
  return after_steps(context, geometry, scheme, steps, options);
}

/// A scheme with limit masks.
Result<SubdivisionScheme> limit_scheme_of(const std::string& text) {
  if (const auto scheme = subdivision_scheme(text); scheme && has_limit(*scheme)) return *scheme;
  return Error{ErrorCode::invalid_value, "limitPosition: expected one of {}, got {}",
               subdivision_scheme_names(has_limit), text};
}

template <typename T>
Result<Mesh3d> at_limit(Context& context, const T& geometry, const SubdivisionScheme& scheme,
                        const SubdivisionOptions& options) {
  A3D_ASSIGN(const SubdivisionInput input, input_of(context, "limitPosition", geometry));
  auto result = limit_mesh(input.mesh, attributes_of_input(geometry), scheme, options, context.monitor());
  if (!result.ok()) return named("limitPosition", result.error());
  // Two edges of a divided mesh may join the same vertices; all are linked anew by their vertices.
  if (input.is_divided)
    result->mesh = PolygonMesh(result->mesh.points(), result->mesh.layout(), result->mesh.origins());
  return Mesh3d(std::move(result->mesh), std::move(result->attributes));
}

template <typename T>
Result<Mesh3d> limit_of(Context& context, const T& geometry, const std::string& scheme_name) {
  A3D_ASSIGN(const SubdivisionScheme scheme, limit_scheme_of(scheme_name));
  return at_limit(context, geometry, scheme, {});
}

template <typename T>
Result<Mesh3d> limit_by_variant(Context& context, const T& geometry, const std::string& scheme_name,
                                const std::string& variant) {
  A3D_ASSIGN(const SubdivisionScheme scheme, limit_scheme_of(scheme_name));
  A3D_ASSIGN(const SubdivisionOptions options, options_of("limitPosition", scheme, variant));
  return at_limit(context, geometry, scheme, options);
}

/// A clause that lists the variants of each scheme that has some: "of loop the weights "loop" (the default), "warren"".
std::string variants_text(bool (*property)(const SubdivisionScheme&)) {
  std::string text;
  for (const SubdivisionScheme& scheme : subdivision_schemes()) {
    if (!property(scheme) || variants_of(scheme).empty()) continue;
    text += fmt::format("{}of {} the {} ", text.empty() ? "" : "; ", name_of(scheme), kind_of_variants(scheme));
    for (const std::string_view& variant : variants_of(scheme))
      text += fmt::format(R"({}"{}"{})", &variant == variants_of(scheme).data() ? "" : ", ", variant,
                          &variant == variants_of(scheme).data() ? " (the default)" : "");
  }
  return text;
}

bool takes_any_faces(const SubdivisionScheme& scheme) {
  return !takes_triangles_only(scheme);
}
bool takes_two_edges(const SubdivisionScheme& scheme) {
  return !needs_three_edges(scheme);
}

const std::string kSquareOf8 = "(mesh3d (((0 0 0) (8 0 0) (8 8 0) (0 8 0)) ((0 1 2 3))))";
const std::string kTriangleMesh = "(mesh3d (((0 0 0) (16 0 0) (0 16 0)) ((0 1 2))))";
const std::string kTetrahedronOf16 =
    "(mesh3d (((0 0 0) (16 0 0) (0 16 0) (0 0 16)) ((0 2 1) (0 1 3) (1 2 3) (2 0 3))))";
const std::string kSurface = "(surface3d (((0 0 0) (16 0 0) (0 16 0))))";
const std::string kSolid =
    "(volume3d (((0 0 0) (0 15 0) (15 0 0)) ((0 0 0) (15 0 0) (0 0 15)) ((15 0 0) (0 15 0) (0 0 15)) ((0 15 0) (0 0 0) "
    "(0 0 15))))";
const std::string kSolidMesh =
    "(((0.0 0.0 0.0) (0.0 15.0 0.0) (15.0 0.0 0.0) (0.0 0.0 15.0)) ((0 1 2) (0 2 3) (2 1 3) (1 0 3)))";
const std::string kLoopTriangle =
    "(((2.0 2.0 0.0) (12.0 2.0 0.0) (2.0 12.0 0.0) (8.0 0.0 0.0) (8.0 8.0 0.0) (0.0 8.0 0.0)) "
    "((0 3 5) (1 4 3) (2 5 4) (3 4 5)))";
const std::string kButterflyTriangle =
    "(((0.0 0.0 0.0) (16.0 0.0 0.0) (0.0 16.0 0.0) (9.0 -2.0 0.0) (9.0 9.0 0.0) (-2.0 9.0 0.0)) "
    "((0 3 5) (1 4 3) (2 5 4) (3 4 5)))";
const std::string kThreeOnAnEdge = "(mesh3d (((0 0 0) (1 0 0) (0 1 0) (0 0 1) (0 -1 0)) ((0 1 2) (0 1 3) (0 1 4))))";
const std::string kCreasedSquare =
    R"((mesh3d (((0 0 0) (8 0 0) (8 8 0) (0 8 0)) ((0 1 2 3)) ((vertex "Corner" real (10 0 0 0.5))))))";
std::string refused_text() {
  return fmt::format(
      "Solids and surfaces are divided where their faces touch in edges or vertices, with a note: of a solid the "
      "bodies, of a surface all faces along an edge of more than two. Errors: non-manifold edges and vertices of a "
      "mesh3d; faces of a surface that run along their edge in the same direction; faces that are not triangles, "
      "except for {}; interior vertices with fewer than three edges, except for "
      "{}.",
      subdivision_scheme_names(takes_any_faces), subdivision_scheme_names(takes_two_edges));
}
std::string creases_text() {
  return fmt::format(
      R"(Creases, for {}: the reals named "Crease" of edges and "Corner" of vertices are their sharpness; )"
      "undefined is 0. An edge or vertex of sharpness s is sharp for s steps, by a fraction in the last one, and from "
      "10 on for all. ",
      subdivision_scheme_names(honours_creases));
}

}  // namespace

void register_subdivision(OperatorGroup& group) {
  group.add({
      .name = "subdivide",
      .syntax = "subdivide(_ ...)",
      .doc = "The mesh after a number of steps of a subdivision scheme, as a mesh3d.",
      .detail =
          fmt::format(
              "Schemes: {} for faces of any degree; {} for triangles. A fourth argument chooses the variant: {}. ",
              subdivision_scheme_names(takes_any_faces), subdivision_scheme_names(takes_triangles_only),
              variants_text([](const SubdivisionScheme&) { return true; })) +
          "Coordinates are rounded to doubles first, and the result has doubles; in each step the error is below "
          "(n + 16) 2^-52 times the largest coordinate, with n the largest "
          "number of edges at a vertex or of corners of a face. Without steps the mesh itself. Surfaces and solids "
          "are taken with the triangles that they have. Boundaries of open meshes become curves of their own: cubic "
          "B-splines, with doo-sabin quadratic ones, with the butterfly schemes curves through the vertices; with the "
          "rule open of doo-sabin they shrink. sqrt3 divides boundary edges into three in every second step. Vertices "
          "keep their numbers, also isolated ones, which stay where they are; then come those on edges, then those of "
          "faces. With doo-sabin each vertex is a corner of a face of the mesh, or on a boundary edge, so isolated "
          "ones are left out. Attributes are kept: numbers of vertices have the weights of coordinates; those of "
          "corners are interpolated linearly within each face, so that seams stay; new faces and halves of edges "
          "have those of the face or edge that they come from; texts are kept where they agree. " +
          creases_text() + "Undefined for a negative number of steps. " + refused_text() +
          " A result with too many faces is refused before work begins.",
      .exactness = Exactness::bounded,
      .frame_use = FrameUse::coordinates,
      .sources = {"catmull1978", "doo1978", "loop1987", "warren2001", "dyn1990", "zorin1996", "kobbelt2000",
                  "derose1998"},
      .overloads = {overload<&subdivided_mesh<Mesh3d>>("mesh", "scheme", "steps"),
                    overload<&subdivided_by_variant<Mesh3d>>("mesh", "scheme", "steps", "variant"),
                    overload<&subdivided_mesh<Surface3d>>("surface", "scheme", "steps"),
                    overload<&subdivided_by_variant<Surface3d>>("surface", "scheme", "steps", "variant"),
                    overload<&subdivided_mesh<Volume3d>>("solid", "scheme", "steps"),
                    overload<&subdivided_by_variant<Volume3d>>("solid", "scheme", "steps", "variant")},
      .examples = {{{kSquareOf8, R"("catmull-clark")", "1"},
                    "(((1.0 1.0 0.0) (7.0 1.0 0.0) (7.0 7.0 0.0) (1.0 7.0 0.0) (4.0 0.0 0.0) (8.0 4.0 0.0) "
                    "(4.0 8.0 0.0) (0.0 4.0 0.0) (4.0 4.0 0.0)) ((0 4 8 7) (1 5 8 4) (2 6 8 5) (3 7 8 6)))"},
                   {{kSquareOf8, R"("doo-sabin")", "1"},
                    "(((2.0 2.0 0.0) (6.0 2.0 0.0) (6.0 6.0 0.0) (2.0 6.0 0.0) (2.0 0.0 0.0) (6.0 0.0 0.0) "
                    "(8.0 2.0 0.0) (8.0 6.0 0.0) (6.0 8.0 0.0) (2.0 8.0 0.0) (0.0 6.0 0.0) (0.0 2.0 0.0)) ((0 1 2 3) "
                    "(1 0 4 5) (2 1 6 7) (3 2 8 9) (0 3 10 11) (0 11 4) (1 5 6) (2 7 8) (3 9 10)))"},
                   {{kSquareOf8, R"("doo-sabin")", "1", R"("open")"},
                    "(((2.0 2.0 0.0) (6.0 2.0 0.0) (6.0 6.0 0.0) (2.0 6.0 0.0)) ((0 1 2 3)))"},
                   {{kTriangleMesh, R"("sqrt3")", "1"},
                    "(((0.0 0.0 0.0) (16.0 0.0 0.0) (0.0 16.0 0.0) (5.333333333333333 5.333333333333333 0.0)) "
                    "((0 1 3) (1 2 3) (2 0 3)))"},
                   {{kCreasedSquare, R"("catmull-clark")", "1"},
                    "(((0.0 0.0 0.0) (7.0 1.0 0.0) (7.0 7.0 0.0) (0.5 7.5 0.0) (4.0 0.0 0.0) (8.0 4.0 0.0) "
                    "(4.0 8.0 0.0) (0.0 4.0 0.0) (4.0 4.0 0.0)) ((0 4 8 7) (1 5 8 4) (2 6 8 5) (3 7 8 6)) ((vertex "
                    R"("Corner" real (10.0 0.0 0.0 0.0 undefined undefined undefined undefined undefined)))))"},
                   {{kTriangleMesh, R"("loop")", "1"}, kLoopTriangle},
                   {{kTriangleMesh, R"("butterfly")", "1"}, kButterflyTriangle},
                   {{kTriangleMesh, R"("modified-butterfly")", "1"}, kButterflyTriangle},
                   {{kTriangleMesh, R"("loop")", "1", R"("warren")"}, kLoopTriangle},
                   {{kSurface, R"("loop")", "1"}, kLoopTriangle},
                   {{kSurface, R"("loop")", "1", R"("loop")"}, kLoopTriangle},
                   {{kSolid, R"("butterfly")", "0"}, kSolidMesh},
                   {{kSolid, R"("loop")", "0", R"("warren")"}, kSolidMesh},
                   {{kSquareOf8, R"("catmull-clark")", "-1"}, "undefined"},
                   {{"(mesh3d undefined)", R"("loop")", "1"}, "undefined"}},
      .errors = {{{kSquareOf8, R"("Loop")", "1"},
                  R"(subdivide: unknown scheme "Loop", expected one of catmull-clark, doo-sabin, loop, butterfly, )"
                  "modified-butterfly, sqrt3"},
                 {{kSquareOf8, R"("loop")", "1"},
                  "subdivide: face 0 has 4 corners, but loop takes triangles only; triangulate the mesh first"},
                 {{kTetrahedronOf16, R"("loop")", "1", R"("sabin")"},
                  R"(subdivide: loop has no weights "sabin", expected one of loop, warren)"},
                 {{kTetrahedronOf16, R"("butterfly")", "1", R"("warren")"},
                  R"(subdivide: butterfly has no variants, got "warren")"},
                 {{kThreeOnAnEdge, R"("loop")", "1"},
                  "subdivide: the edge between vertices 0 and 1 is non-manifold: 3 half-edges run along it"},
                 {{kTetrahedronOf16, R"("loop")", "15"},
                  "subdivide: 15 steps make more than 2147483645 half-edges of 12"}},
  });
  group.add({
      .name = "limitPosition",
      .syntax = "limitPosition(_ ...)",
      .doc = "The mesh with each vertex where it is when the mesh is subdivided without end, as a mesh3d.",
      .detail =
          fmt::format("Faces and their numbers are those of the mesh. Attributes are kept; numbers of vertices move as "
                      "the points do. Schemes: {}. A third argument chooses the variant: {}. ",
                      subdivision_scheme_names(has_limit), variants_text(has_limit)) +
          "The limits are those of the schemes' limit masks, with errors as in subdivide; boundary vertices are on "
          "cubic B-splines, with doo-sabin on quadratic ones. With doo-sabin, which makes a face of each vertex, the "
          "limit is that of this face; a boundary vertex has none with the rule open. So "
          R"(limitPosition(subdivide(m, "loop", 2), "loop") has points of the smooth surface itself. Isolated )"
          "vertices stay. " +
          creases_text() +
          "Where a sharpness is neither 0 nor from 10 on, so many steps are made first, at their cost. " +
          refused_text(),
      .exactness = Exactness::bounded,
      .frame_use = FrameUse::coordinates,
      .sources = {"halstead1993", "loop1987", "warren2001", "doo1978", "derose1998"},
      .overloads = {overload<&limit_of<Mesh3d>>("mesh", "scheme"),
                    overload<&limit_by_variant<Mesh3d>>("mesh", "scheme", "variant"),
                    overload<&limit_of<Surface3d>>("surface", "scheme"),
                    overload<&limit_by_variant<Surface3d>>("surface", "scheme", "variant"),
                    overload<&limit_of<Volume3d>>("solid", "scheme"),
                    overload<&limit_by_variant<Volume3d>>("solid", "scheme", "variant")},
      .examples = {{{"(mesh3d (((0 0 0) (6 0 0) (6 6 0) (0 6 0)) ((0 1 2 3))))", R"("catmull-clark")"},
                    "(((1.0 1.0 0.0) (5.0 1.0 0.0) (5.0 5.0 0.0) (1.0 5.0 0.0)) ((0 1 2 3)))"},
                   {{kSquareOf8, R"("doo-sabin")"},
                    "(((1.0 1.0 0.0) (7.0 1.0 0.0) (7.0 7.0 0.0) (1.0 7.0 0.0)) ((0 1 2 3)))"},
                   {{"(mesh3d (((0 0 0) (12 0 0) (0 12 0)) ((0 1 2))))", R"("loop")"},
                    "(((2.0 2.0 0.0) (8.0 2.0 0.0) (2.0 8.0 0.0)) ((0 1 2)))"},
                   {{kTetrahedronOf16, R"("loop")", R"("warren")"},
                    "(((3.2 3.2 3.2) (6.4 3.2 3.2) (3.2 6.4 3.2) (3.2 3.2 6.4)) ((0 2 1) (0 1 3) (1 2 3) (2 0 3)))"},
                   {{kSolid, R"("loop")"},
                    "(((3.0 3.0 3.0) (3.0 6.0 3.0) (6.0 3.0 3.0) (3.0 3.0 6.0)) ((0 1 2) (0 2 3) (2 1 3) (1 0 3)))"},
                   {{kSurface, R"("loop")", R"("warren")"},
                    "(((2.6666666666666665 2.6666666666666665 0.0) (10.666666666666666 2.6666666666666665 0.0) "
                    "(2.6666666666666665 10.666666666666666 0.0)) ((0 1 2)))"},
                   {{"(mesh3d undefined)", R"("loop")"}, "undefined"}},
      .errors = {{{kTetrahedronOf16, R"("sqrt3")"},
                  "limitPosition: expected one of catmull-clark, doo-sabin, loop, got sqrt3"},
                 {{kTetrahedronOf16, R"("no")"},
                  "limitPosition: expected one of catmull-clark, doo-sabin, loop, got no"},
                 {{kTetrahedronOf16, R"("loop")", R"("no")"},
                  R"(limitPosition: loop has no weights "no", expected one of loop, warren)"},
                 {{kSquareOf8, R"("doo-sabin")", R"("open")"},
                  "limitPosition: vertex 0 is on the boundary, where the rule open makes no faces, so it has no limit"},
                 {{kSquareOf8, R"("loop")"}, "limitPosition: face 0 has 4 corners, but loop takes triangles only"}},
  });
}

}  // namespace algebra3d
