#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"

/// Checks of the arrays from which users of the libraries make meshes. Errors: invalid_value with the place;
/// limit_exceeded beyond what a mesh may have. Cost: linear; they poll for an interruption.
namespace algebra3d {

/// Every coordinate is finite.
Status check_points(std::span<const Vec3> points);
/// Every corner is below `point_count`.
Status check_corners(std::size_t point_count, std::span<const std::uint32_t> corners);
Status check_triangles(std::size_t point_count, std::span<const std::array<std::uint32_t, 3>> triangles);
/// The layout of faces with so many corners each, 3 or more, which are `corner_count` together.
Result<PolygonLayout> layout_of(std::span<const std::uint32_t> degrees, std::size_t corner_count);

}  // namespace algebra3d
