#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "base/large_allocator.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {

/// The arrays of a mesh that a step fills, with all links known.
struct RefinedMesh {
  std::vector<Vec3> points;
  LargeVector<std::uint32_t> corners;    // per half-edge: its origin
  LargeVector<std::uint32_t> opposites;  // per half-edge
  LargeVector<HalfedgeId> outgoing;      // per vertex

  RefinedMesh(std::size_t vertex_count, std::size_t halfedge_count) {
    points.reserve(vertex_count);
    prefer_huge_pages(points.data(), vertex_count * sizeof(Vec3));
    points.resize(vertex_count);
    corners.resize(halfedge_count);
    opposites.resize(halfedge_count);
    outgoing.resize(vertex_count);
  }

  /// The vertex that a half-edge leaves.
  void set_corner(HalfedgeId h, VertexId v) { corners[h.index()] = v.index(); }
  /// The opposite of h, none at the boundary.
  void set_opposite(HalfedgeId h, HalfedgeId o) { opposites[h.index()] = o.index(); }
  /// Makes two half-edges opposite to each other.
  void link(HalfedgeId a, HalfedgeId b) {
    set_opposite(a, b);
    set_opposite(b, a);
  }
  void set_vertex(VertexId v, const Vec3& point, HalfedgeId leaving) {
    points[v.index()] = point;
    outgoing[v.index()] = leaving;
  }

  /// The mesh, or the error that the work is cancelled: then the arrays are not filled.
  Result<PolygonMesh> finish(PolygonLayout layout, const Monitor& monitor) && {
    A3D_TRY(monitor.check());
    return PolygonMesh(PointArray(std::move(points)), std::move(layout), std::move(corners), std::move(opposites),
                       std::move(outgoing));
  }
};

}  // namespace algebra3d::subdivision
