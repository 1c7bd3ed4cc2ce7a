#include "algebra3d/mesh/topology.h"

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/meshes/mesh_access.h"
#include "base/without_exceptions.h"

namespace algebra3d::mesh {

using detail::MeshAccess;

template <AnyMesh M>
std::vector<BoundaryLoop> boundary_loops(const M& mesh) {
  return algebra3d::boundary_loops(MeshAccess::content(mesh));
}

template <AnyMesh M>
FaceComponents connected_components(const M& mesh) {
  return algebra3d::connected_components(MeshAccess::content(mesh));
}

template <AnyMesh M>
bool is_closed(const M& mesh) {
  return algebra3d::is_closed(MeshAccess::content(mesh));
}

template <AnyMesh M>
bool is_consistently_oriented(const M& mesh) {
  return algebra3d::is_consistently_oriented(MeshAccess::content(mesh));
}

template <AnyMesh M>
std::int64_t euler_characteristic(const M& mesh) {
  return algebra3d::euler_characteristic(MeshAccess::content(mesh));
}

template <AnyMesh M>
Result<std::int64_t> genus(const M& mesh) {
  return without_exceptions([&]() -> Result<std::int64_t> {
    const Maybe<std::int64_t> found = algebra3d::genus(MeshAccess::content(mesh));
    if (!found) return Error{ErrorCode::invalid_value, "genus: {}", found.reason()};
    return *found;
  });
}

template std::vector<BoundaryLoop> boundary_loops(const TriangleMesh&);
template std::vector<BoundaryLoop> boundary_loops(const PolygonMesh&);
template FaceComponents connected_components(const TriangleMesh&);
template FaceComponents connected_components(const PolygonMesh&);
template bool is_closed(const TriangleMesh&);
template bool is_closed(const PolygonMesh&);
template bool is_consistently_oriented(const TriangleMesh&);
template bool is_consistently_oriented(const PolygonMesh&);
template std::int64_t euler_characteristic(const TriangleMesh&);
template std::int64_t euler_characteristic(const PolygonMesh&);
template Result<std::int64_t> genus(const TriangleMesh&);
template Result<std::int64_t> genus(const PolygonMesh&);

}  // namespace algebra3d::mesh
