#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/kernel/soup/weld.h"
#include "base/polygon_soup.h"

namespace algebra3d {

/// Sorts triangles in Morton order of their centres; stable: result[i] is the triangle at position i. Deterministic.
/// Cost: linear (radix sort, or less if nearly sorted).
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points,
                                         std::span<const TriangleMesh::Triangle> triangles);

/// Reorders triangles; points are numbered by first use.
WeldedTriangles reordered(const WeldedTriangles& welded, std::span<const std::uint32_t> order);

/// The polygons in Morton order of the means of their corners, with points numbered by first use; others are left out.
/// The soup must have no attributes (asserted). Cost: linear.
PolygonSoup in_spatial_order(const PolygonSoup& soup);

/// The mesh with its triangles in spatial order and points numbered by first use.
TriangleMesh in_spatial_order(const TriangleMesh& mesh);

}  // namespace algebra3d
