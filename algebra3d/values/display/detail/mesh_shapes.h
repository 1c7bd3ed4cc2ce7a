#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/values/display/shape.h"

namespace algebra3d::detail {

/// Edges whose faces make a larger angle divide the normals.
inline constexpr double kCreaseDegrees = 30;

/// Meshes of more triangles, or as many half-edges, show creases only: all other edges would be closer than pixels, and
/// as large as everything else.
inline constexpr std::size_t kMostFacesWithAllEdges = 1'000'000;

/// The shape of a mesh in a box. Positions are numbered by vertex, then round it; after them come isolated vertices.
/// Errors: limit_exceeded, interrupted. Cost: linear.
Result<DrawnShape> shape_of_mesh(const TriangleMesh& mesh, const Box3& box, const Monitor& monitor);
Result<DrawnShape> shape_of_mesh(const PolygonMesh& mesh, const Box3& box, const Monitor& monitor);

}  // namespace algebra3d::detail
