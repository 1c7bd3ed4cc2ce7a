#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/repair/weld.h"

namespace algebra3d {

/// The triangles in Morton order of their centres, ties in the order given: result[i] is the triangle that comes at
/// place i. Deterministic. Cost: linear (radix sort, or less where hardly any is out of its place).
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points,
                                         std::span<const TriangleMesh::Triangle> triangles);

/// `welded` with its triangles in the given order, and points numbered in the order in which these first use them.
WeldedTriangles reordered(const WeldedTriangles& welded, std::span<const std::uint32_t> order);

/// The mesh with its triangles in spatial order, and points numbered in the order in which these first use them.
TriangleMesh in_spatial_order(const TriangleMesh& mesh);

}  // namespace algebra3d
