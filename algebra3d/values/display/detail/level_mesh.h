#pragma once

#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/values/display/shape.h"
#include "algebra3d/values/display/vertex_clustering.h"

namespace algebra3d::detail {

/// The defects of a mesh as pairs of vertices, each edge once.
struct DefectEdges {
  LargeVector<DrawnShape::Line> boundary, nonmanifold;
};

template <typename Layout>
DefectEdges defects_of(const HalfedgeMesh<Layout>& mesh);

/// The edges after vertices were drawn together: each joins the new places of its ends.
DefectEdges drawn_together(const DefectEdges& edges, const std::vector<std::uint32_t>& point_of);

/// The shape of a level. `whole` has no arrays: it gives kind, box, origin and number of triangles of the value, and
/// points of the level are relative to its origin. Points without a triangle are drawn, up to `max_points`. Errors:
/// interrupted.
Result<DrawnShape> shape_of_level(const DrawnShape& whole, const ClusteredTriangles& level, const DefectEdges& defects,
                                  std::size_t max_points, const Monitor& monitor);

}  // namespace algebra3d::detail
