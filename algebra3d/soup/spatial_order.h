#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/soup/weld.h"

namespace algebra3d {

/// Sorts triangles in Morton order of their centres; stable: result[i] is the triangle at position i. Deterministic.
/// Cost: linear (radix sort, or less if nearly sorted).
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points,
                                         std::span<const TriangleMesh::Triangle> triangles);

/// Reorders triangles; points are numbered by first use.
WeldedTriangles reordered(const WeldedTriangles& welded, std::span<const std::uint32_t> order);

/// The mesh with its triangles in spatial order and points numbered by first use.
TriangleMesh in_spatial_order(const TriangleMesh& mesh);

}  // namespace algebra3d
