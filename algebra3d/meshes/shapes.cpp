#include "algebra3d/mesh/shapes.h"

#include <memory>
#include <utility>

#include "algebra3d/library/shape_access.h"
#include "algebra3d/meshes/mesh_access.h"
#include "algebra3d/values/constructions/mesh_conversions.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

namespace algebra3d::mesh {
namespace {

using algebra3d::detail::ShapeAccess;
using detail::MeshAccess;

/// The mesh of a value, which lives as long as it is used.
template <typename Content>
std::shared_ptr<const algebra3d::TriangleMesh> shared_mesh_of(const Content& content) {
  const auto owner = std::make_shared<const Content>(content);
  return {owner, &owner->mesh()};
}

template <typename Content, AnyMesh M>
Result<Content> proved_content(const M& mesh, const Monitor& monitor) {
  A3D_ASSIGN(algebra3d::TriangleMesh triangles, welded_triangles_of(detail::polygons_of(mesh), monitor));
  A3D_ASSIGN(Maybe<Content> content, Content::prove(std::move(triangles), {.cancel = monitor.cancel()}));
  if (!content) return Error{ErrorCode::invalid_value, content.reason()};
  return *std::move(content);
}

}  // namespace

TriangleMesh mesh_of(const Solid& solid) {
  return MeshAccess::outer(shared_mesh_of(ShapeAccess::content(solid)));
}

TriangleMesh mesh_of(const Surface& surface) {
  return MeshAccess::outer(shared_mesh_of(ShapeAccess::content(surface)));
}

template <AnyMesh M>
Result<Solid> solid_of(const M& mesh, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Solid> {
    const InterruptionScope interruption(monitor.cancel());
    return ShapeAccess::outer(proved_content<Volume3d>(mesh, monitor));
  });
}

template <AnyMesh M>
Result<Surface> surface_of(const M& mesh, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Surface> {
    const InterruptionScope interruption(monitor.cancel());
    return ShapeAccess::outer(proved_content<Surface3d>(mesh, monitor));
  });
}

template Result<Solid> solid_of(const TriangleMesh&, const Monitor&);
template Result<Solid> solid_of(const PolygonMesh&, const Monitor&);
template Result<Surface> surface_of(const TriangleMesh&, const Monitor&);
template Result<Surface> surface_of(const PolygonMesh&, const Monitor&);

}  // namespace algebra3d::mesh
