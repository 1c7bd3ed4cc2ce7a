// addVertex, addFace, removeFace.
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/mesh_building.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/ascii_cursor.h"

namespace algebra3d {
namespace {

Mesh3d add_vertex(const Mesh3d& mesh, const Point3d& point) {
  return with_vertex(mesh, point.position);
}

Result<Maybe<Mesh3d>> add_triangle(const Mesh3d& mesh, std::int64_t a, std::int64_t b, std::int64_t c) {
  return with_face(mesh, std::array{a, b, c});
}

Result<Maybe<Mesh3d>> add_quad(const Mesh3d& mesh, std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  return with_face(mesh, std::array{a, b, c, d});
}

Result<Maybe<Mesh3d>> add_polygon(const Mesh3d& mesh, const Text& corners) {
  std::vector<std::int64_t> numbers;
  AsciiCursor cursor(corners.content.data(), corners.content.data() + corners.content.size());
  for (cursor.skip_space(); !cursor.is_at_end(); cursor.skip_space()) {
    std::uint64_t number = 0;
    if (!cursor.take_digits(number))
      return Maybe<Mesh3d>(Undefined{
          fmt::format("the corners are '{}'; expected numbers of vertices with blanks between them", corners.content)});
    numbers.push_back(static_cast<std::int64_t>(number));
  }
  return with_face(mesh, numbers);
}

Maybe<Mesh3d> remove_face(const Mesh3d& mesh, std::int64_t face) {
  return without_face(mesh, face);
}

const std::string kFourPoints = "(mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ()))";

constexpr const char* kKept =
    "Vertices and faces are numbered from 0. Attributes are kept; those of new elements are undefined.";

void register_adding(OperatorGroup& group) {
  group.add({
      .name = "addVertex",
      .syntax = "addVertex(_, _)",
      .doc = "The mesh with a vertex more, which is the last one.",
      .detail = kKept,
      .exactness = Exactness::exact,
      .overloads = {overload<&add_vertex>("mesh", "point")},
      .examples = {{{"(mesh3d (() ()))", "(makePoint3D 1 2 3)"}, "(((1.0 2.0 3.0)) ())"},
                   {{kUndefinedMesh, kOrigin}, "undefined"}},
      .errors = {{{kFourPoints, "1"}, "addVertex: expected (mesh3d point3d), got (mesh3d int)"}},
  });
  group.add({
      .name = "addFace",
      .syntax = "addFace(_ ...)",
      .doc = "The mesh with a face more, which is the last one: by the numbers of its three or four corners, or a text "
             "with the numbers of any corners.",
      .detail = std::string(kKept) + " The mesh may become non-manifold. Undefined if a number is not a vertex, or for "
                                     "fewer than three corners.",
      .exactness = Exactness::exact,
      .overloads = {overload<&add_triangle>("mesh", "a", "b", "c"), overload<&add_quad>("mesh", "a", "b", "c", "d"),
                    overload<&add_polygon>("mesh", "corners")},
      .examples = {{{kFourPoints, "0", "1", "2"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2)))"},
                   {{kFourPoints, "'0 1 2 3'"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2 3)))"},
                   {{kFourPoints, "0", "1", "4"}, "undefined"},
                   {{kUndefinedMesh, "0", "1", "2"}, "undefined"}},
      .errors = {{{kFourPoints, "1"},
                  "addFace: expected (mesh3d int int int), (mesh3d int int int int) or (mesh3d "
                  "text), got (mesh3d int)"}},
  });
}

}  // namespace

void register_mesh_building(OperatorGroup& group) {
  register_adding(group);
  group.add({
      .name = "removeFace",
      .syntax = "removeFace(_, _)",
      .doc = "The mesh without a face; the faces behind it are renumbered.",
      .detail = std::string(kKept) + " Vertices stay, also those that no face uses any more. Undefined if the number "
                                     "is not a face.",
      .exactness = Exactness::exact,
      .overloads = {overload<&remove_face>("mesh", "face")},
      .examples = {{{"(addFace " + kFourPoints + " 0 1 2)", "0"}, "0", "(size _)"},
                   {{kFourPoints, "0"}, "undefined"},
                   {{kUndefinedMesh, "0"}, "undefined"}},
      .errors = {{{kFourPoints, "TRUE"}, "removeFace: expected (mesh3d int), got (mesh3d bool)"}},
  });
}

}  // namespace algebra3d
