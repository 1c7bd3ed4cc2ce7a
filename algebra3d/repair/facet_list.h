#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/weld.h"

namespace algebra3d {

/// The facets of a file on their way to a solid. Points are doubles; no two are equal, but some may be unused.
struct FacetList {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;

  explicit FacetList(const WeldedTriangles& welded) : points(welded.points.approx()), triangles(welded.triangles) {}

  const Vec3& corner(std::size_t triangle, std::size_t i) const { return points[triangles[triangle][i]]; }
  Vec3 middle(std::size_t triangle) const {
    return (1.0 / 3) * corner(triangle, 0) + (1.0 / 3) * corner(triangle, 1) + (1.0 / 3) * corner(triangle, 2);
  }
  TriangleMesh mesh() const { return {PointArray(points), triangles}; }
};

}  // namespace algebra3d
