// components.
#include <optional>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/solid_components.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {
namespace {

template <typename T>
Result<std::vector<T>> components_or_none(Context& context, const std::optional<T>& geometry) {
  return geometry ? components_of(context, *geometry) : std::vector<T>();
}

const std::string kTwoTriangles = "(surface3d (((0 0 0) (1 0 0) (0 1 0)) ((0 0 0) (0 -1 0) (-1 0 0))))";
const std::string kSquare = "(surface3d (((0 0 0) (1 0 0) (1 1 0)) ((0 0 0) (1 1 0) (0 1 0))))";

}  // namespace

void register_decomposition(OperatorGroup& group) {
  group.add({
      .name = "components",
      .syntax = "components(_)",
      .doc = "The parts of a surface or solid that are connected across common edges.",
      .detail = "Triangles that share only a point are not connected. The boundary of a cavity belongs to the body "
                "around it; a body in a cavity is a separate part. Parts are in the order of their first triangles; "
                "an undefined or empty argument has none.",
      .exactness = Exactness::exact,
      .overloads = {overload<&components_or_none<Surface3d>>("surface"),
                    overload<&components_or_none<Volume3d>>("solid")},
      .examples = {{{kTwoTriangles}, "2", "(count _)"},
                   {{kSquare}, "1", "(count _)"},
                   {{"(createCube (makePoint3D 0 0 0) (makePoint3D 1 1 1))"}, "1", "(count _)"},
                   {{"(volume3d undefined)"}, "0", "(count _)"}},
      .errors = {{{"(makePoint3D 0 0 0)"}, "components: expected (surface3d) or (volume3d), got (point3d)"}},
  });
}

}  // namespace algebra3d
