// subdivide, limitPosition.
#include <string>
#include <utility>

#include <fmt/format.h>

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

const PolygonMesh& polygon_mesh_of(const Mesh3d& mesh) {
  return mesh.mesh();
}
/// The triangles as they are.
template <typename T>
PolygonMesh polygon_mesh_of(const T& geometry) {
  return {geometry.mesh().points(), PolygonLayout::of_degree(3), geometry.mesh().origins()};
}

const MeshAttributes& attributes_of_input(const Mesh3d& mesh) {
  return mesh.attributes();
}
template <typename T>
MeshAttributes attributes_of_input(const T& /*geometry*/) {
  return {};
}

Error named(const char* name, Error error) {
  return std::move(error).about(name);
}

Result<SubdivisionScheme> scheme_of(const char* name, const std::string& text) {
  if (const auto scheme = subdivision_scheme(text)) return *scheme;
  return Error{ErrorCode::invalid_value, R"({}: unknown scheme "{}", expected one of {})", name, text,
               subdivision_scheme_names()};
}

Result<SubdivisionOptions> options_of(const char* name, SubdivisionScheme scheme, const std::string& weights) {
  const auto known = loop_weights(weights);
  if (!known)
    return Error{ErrorCode::invalid_value, R"({}: unknown weights "{}", expected one of loop, warren)", name, weights};
  if (scheme != SubdivisionScheme::loop)
    return Error{ErrorCode::invalid_value, R"({}: weights "{}" are for the scheme loop, got {})", name, weights,
                 name_of(scheme)};
  return SubdivisionOptions{*known};
}

template <typename T>
Result<Maybe<Mesh3d>> after_steps(Context& context, const T& geometry, SubdivisionScheme scheme, std::int64_t steps,
                                  const SubdivisionOptions& options) {
  if (steps < 0) return Maybe<Mesh3d>(Undefined{"the number of steps is negative"});
  auto result = subdivided(polygon_mesh_of(geometry), attributes_of_input(geometry), scheme,
                           static_cast<std::size_t>(steps), options, context.monitor());
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
Result<Maybe<Mesh3d>> subdivided_with_weights(Context& context, const T& geometry, const std::string& scheme_name,
                                              std::int64_t steps, const std::string& weights) {
  A3D_ASSIGN(const SubdivisionScheme scheme, scheme_of("subdivide", scheme_name));
  A3D_ASSIGN(const SubdivisionOptions options, options_of("subdivide", scheme, weights));
  return after_steps(context, geometry, scheme, steps, options);
}

/// A scheme with limit masks.
Result<SubdivisionScheme> limit_scheme_of(const std::string& text) {
  const auto scheme = subdivision_scheme(text);
  if (scheme == SubdivisionScheme::catmull_clark || scheme == SubdivisionScheme::loop) return *scheme;
  return Error{ErrorCode::invalid_value, "limitPosition: expected one of catmull-clark, loop, got {}", text};
}

template <typename T>
Result<Mesh3d> at_limit(Context& context, const T& geometry, SubdivisionScheme scheme,
                        const SubdivisionOptions& options) {
  auto result = limit_mesh(polygon_mesh_of(geometry), scheme, options, context.monitor());
  if (!result.ok()) return named("limitPosition", result.error());
  return Mesh3d(*std::move(result), attributes_of_input(geometry));
}

template <typename T>
Result<Mesh3d> limit_of(Context& context, const T& geometry, const std::string& scheme_name) {
  A3D_ASSIGN(const SubdivisionScheme scheme, limit_scheme_of(scheme_name));
  return at_limit(context, geometry, scheme, {});
}

template <typename T>
Result<Mesh3d> limit_with_weights(Context& context, const T& geometry, const std::string& scheme_name,
                                  const std::string& weights) {
  A3D_ASSIGN(const SubdivisionScheme scheme, limit_scheme_of(scheme_name));
  A3D_ASSIGN(const SubdivisionOptions options, options_of("limitPosition", scheme, weights));
  return at_limit(context, geometry, scheme, options);
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
const std::string kRefused =
    "Errors: non-manifold edges and vertices; faces that are not triangles, except for catmull-clark and doo-sabin; "
    "interior vertices with fewer than three edges, except for catmull-clark.";

}  // namespace

void register_subdivision(Registry& registry) {
  registry.add({
      .name = "subdivide",
      .syntax = "subdivide(_ ...)",
      .doc = "The mesh after a number of steps of a subdivision scheme, as a mesh3d.",
      .detail =
          R"(Schemes: "catmull-clark" and "doo-sabin" for faces of any degree; "loop", "butterfly" and )"
          R"("modified-butterfly" for triangles. A fourth argument chooses the weights of loop: "loop" (the )"
          R"(default) or "warren". Coordinates are rounded to doubles first, and the result has )"
          "doubles; in each step the error is below (n + 16) 2^-52 times the largest coordinate, with n the largest "
          "number of edges at a vertex or of corners of a face. Without steps the mesh itself. Surfaces and solids "
          "are taken with the triangles that they have. Boundaries of open meshes become curves of their own; "
          "doo-sabin makes no faces there. Vertices keep their numbers, also isolated ones, which stay where they "
          "are; then come those on edges, then those of faces. With doo-sabin each vertex is a corner of a face of "
          "the mesh, so isolated ones are left out. Attributes are kept: new faces and halves of edges have those of "
          "the face or edge that they come from; those of vertices, and of corners within each face, are interpolated "
          "linearly, and texts are kept where they agree. Undefined for a negative number of steps. " +
          kRefused + " A result with too many faces is refused before work begins.",
      .exactness = Exactness::bounded,
      .frame_use = FrameUse::coordinates,
      .sources = {"catmull1978", "doo1978", "loop1987", "warren2001", "dyn1990", "zorin1996"},
      .overloads = {overload<&subdivided_mesh<Mesh3d>>("mesh", "scheme", "steps"),
                    overload<&subdivided_with_weights<Mesh3d>>("mesh", "scheme", "steps", "weights"),
                    overload<&subdivided_mesh<Surface3d>>("surface", "scheme", "steps"),
                    overload<&subdivided_with_weights<Surface3d>>("surface", "scheme", "steps", "weights"),
                    overload<&subdivided_mesh<Volume3d>>("solid", "scheme", "steps"),
                    overload<&subdivided_with_weights<Volume3d>>("solid", "scheme", "steps", "weights")},
      .examples = {{{kSquareOf8, R"("catmull-clark")", "1"},
                    "(((1.0 1.0 0.0) (7.0 1.0 0.0) (7.0 7.0 0.0) (1.0 7.0 0.0) (4.0 0.0 0.0) (8.0 4.0 0.0) "
                    "(4.0 8.0 0.0) (0.0 4.0 0.0) (4.0 4.0 0.0)) ((0 4 8 7) (1 5 8 4) (2 6 8 5) (3 7 8 6)))"},
                   {{kSquareOf8, R"("doo-sabin")", "1"},
                    "(((2.0 2.0 0.0) (6.0 2.0 0.0) (6.0 6.0 0.0) (2.0 6.0 0.0)) ((0 1 2 3)))"},
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
                  "modified-butterfly"},
                 {{kSquareOf8, R"("loop")", "1"},
                  "subdivide: face 0 has 4 corners, but loop takes triangles only; see triangulate"},
                 {{kTetrahedronOf16, R"("loop")", "1", R"("sabin")"},
                  R"(subdivide: unknown weights "sabin", expected one of loop, warren)"},
                 {{kTetrahedronOf16, R"("butterfly")", "1", R"("warren")"},
                  R"(subdivide: weights "warren" are for the scheme loop, got butterfly)"},
                 {{kThreeOnAnEdge, R"("loop")", "1"},
                  "subdivide: the edge between vertices 0 and 1 is non-manifold: 3 half-edges run along it"},
                 {{kTetrahedronOf16, R"("loop")", "15"},
                  "subdivide: 15 steps make more than 2147483645 half-edges of 12"}},
  });
  registry.add({
      .name = "limitPosition",
      .syntax = "limitPosition(_ ...)",
      .doc = "The mesh with each vertex where it is when the mesh is subdivided without end, as a mesh3d.",
      .detail =
          R"(Faces and their numbers are those of the mesh. Attributes are kept. Schemes: )"
          R"("catmull-clark", and "loop" for triangles; a third argument chooses the weights of loop, "loop" (the )"
          R"(default) or "warren". The limits are those )"
          "of the schemes' limit masks, with errors as in subdivide; boundary vertices are on cubic B-splines. So "
          R"(limitPosition(subdivide(m, "loop", 2), "loop") has points of the smooth surface itself. Isolated )"
          "vertices stay. " +
          kRefused,
      .exactness = Exactness::bounded,
      .frame_use = FrameUse::coordinates,
      .sources = {"halstead1993", "loop1987", "warren2001"},
      .overloads = {overload<&limit_of<Mesh3d>>("mesh", "scheme"),
                    overload<&limit_with_weights<Mesh3d>>("mesh", "scheme", "weights"),
                    overload<&limit_of<Surface3d>>("surface", "scheme"),
                    overload<&limit_with_weights<Surface3d>>("surface", "scheme", "weights"),
                    overload<&limit_of<Volume3d>>("solid", "scheme"),
                    overload<&limit_with_weights<Volume3d>>("solid", "scheme", "weights")},
      .examples = {{{"(mesh3d (((0 0 0) (6 0 0) (6 6 0) (0 6 0)) ((0 1 2 3))))", R"("catmull-clark")"},
                    "(((1.0 1.0 0.0) (5.0 1.0 0.0) (5.0 5.0 0.0) (1.0 5.0 0.0)) ((0 1 2 3)))"},
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
      .errors = {{{kTetrahedronOf16, R"("doo-sabin")"},
                  "limitPosition: expected one of catmull-clark, loop, got doo-sabin"},
                 {{kTetrahedronOf16, R"("no")"}, "limitPosition: expected one of catmull-clark, loop, got no"},
                 {{kTetrahedronOf16, R"("loop")", R"("no")"},
                  R"(limitPosition: unknown weights "no", expected one of loop, warren)"},
                 {{kSquareOf8, R"("loop")"}, "limitPosition: face 0 has 4 corners, but loop takes triangles only"}},
  });
}

}  // namespace algebra3d
