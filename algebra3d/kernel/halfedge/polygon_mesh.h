#pragma once

#include <cstdint>

#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

namespace algebra3d {

/// A mesh of polygons with three or more corners each, by the numbers of their vertices; faces of any degree may stand
/// beside each other. Polygons need not be flat, convex or simple. Memory: where all coordinates are doubles and the
/// mesh is manifold, 28 bytes per vertex and 8 per half-edge, and if degrees differ another 4 per half-edge and per
/// face; so triangles take as much as in a TriangleMesh.
class PolygonMesh : public HalfedgeMesh<PolygonLayout> {
 public:
  /// The empty mesh.
  PolygonMesh() = default;
  /// Links the faces along common edges: `corners` has the vertices of all faces of `layout`, one face after the other.
  /// Every index must be below points.size(), and there must be as many as the layout has half-edges (asserted). Unused
  /// points are kept as isolated vertices. Cost: linear expected (sorting per vertex), no recursion.
  PolygonMesh(PointArray points, PolygonLayout layout, LargeVector<std::uint32_t> corners);
  /// Makes a manifold mesh whose links are known: per half-edge its opposite or kNone, and per vertex the half-edge
  /// `outgoing`: at the boundary the one without opposite, elsewhere the lowest that leaves the vertex. They are taken
  /// as they are; `audit` checks them. Cost: constant.
  PolygonMesh(PointArray points, PolygonLayout layout, LargeVector<std::uint32_t> corners,
              LargeVector<std::uint32_t> opposites, LargeVector<HalfedgeId> outgoing);

  /// The faces and links of another mesh over other points, one per vertex. Cost: that of a copy.
  PolygonMesh(const PolygonMesh& linked, PointArray points);

  /// The layout of the faces; with `origins`, all that a mesh of other points with the same faces needs.
  const PolygonLayout& layout() const { return *this; }
};

}  // namespace algebra3d
