// components.
#include <optional>
#include <vector>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/solid_components.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {
namespace {

Result<std::vector<std::vector<FaceId>>> component_faces(Context& /*context*/, const Surface3d& surface) {
  return connected_components(surface.mesh()).faces();
}
Result<std::vector<std::vector<FaceId>>> component_faces(Context& context, const Volume3d& solid) {
  return solid_components(solid.mesh(), solid.geometry().hierarchy(), context.cancel);
}

template <typename T>
Result<std::vector<T>> components_of(Context& context, const std::optional<T>& geometry) {
  if (!geometry) return std::vector<T>();
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto components, component_faces(context, *geometry));
  if (components.size() == 1) return std::vector<T>{*geometry};
  std::vector<T> result;
  SubmeshMaker maker(geometry->mesh());
  for (const std::vector<FaceId>& faces : components) {
    ALGEBRA3D_RETURN_IF_ERROR(context.check_cancelled());
    // No proof: triangles that are fine among others are so among fewer. A component of a volume holds the outer shell
    // of a body and the walls of its cavities, so next to these the winding numbers are what they were in the whole.
    result.push_back(T::trusted(maker.make(faces)));
  }
  return result;
}

const std::string kTwoTriangles = "(surface3d (((0 0 0) (1 0 0) (0 1 0)) ((0 0 0) (0 -1 0) (-1 0 0))))";
const std::string kSquare = "(surface3d (((0 0 0) (1 0 0) (1 1 0)) ((0 0 0) (1 1 0) (0 1 0))))";

}  // namespace

void register_decomposition(Registry& registry) {
  registry.add({
      .name = "components",
      .syntax = "components(_)",
      .doc = "The parts of a surface or solid that are connected across common edges.",
      .detail = "Triangles that share only a point are not connected. The boundary of a cavity belongs to the body "
                "around it; a body in a cavity is a separate part. Parts are in the order of their first triangles; "
                "an undefined or empty argument has none.",
      .exactness = Exactness::exact,
      .overloads = {overload<&components_of<Surface3d>>("surface"), overload<&components_of<Volume3d>>("solid")},
      .examples = {{{kTwoTriangles}, "2", "(count _)"},
                   {{kSquare}, "1", "(count _)"},
                   {{"(createCube (makePoint3D 0 0 0) (makePoint3D 1 1 1))"}, "1", "(count _)"},
                   {{"(volume3d undefined)"}, "0", "(count _)"}},
      .errors = {{{"(makePoint3D 0 0 0)"}, "components: expected (surface3d) or (volume3d), got (point3d)"}},
  });
}

}  // namespace algebra3d
