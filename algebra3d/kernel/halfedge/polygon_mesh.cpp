#include "algebra3d/kernel/halfedge/polygon_mesh.h"

#include <utility>

namespace algebra3d {

PolygonMesh::PolygonMesh(PointArray points, PolygonLayout layout, LargeVector<std::uint32_t> corners)
    : HalfedgeMesh(std::move(points), std::move(layout), std::move(corners)) {}

PolygonMesh::PolygonMesh(PointArray points, PolygonLayout layout, LargeVector<std::uint32_t> corners,
                         LargeVector<std::uint32_t> opposites, LargeVector<HalfedgeId> outgoing)
    : HalfedgeMesh(std::move(points), std::move(layout), std::move(corners), std::move(opposites), std::move(outgoing),
                   Links::all) {}

PolygonMesh::PolygonMesh(const PolygonMesh& linked, PointArray points) : HalfedgeMesh(linked, std::move(points)) {}

}  // namespace algebra3d
