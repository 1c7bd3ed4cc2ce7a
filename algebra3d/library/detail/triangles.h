#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/geometry/solid.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/soup/weld.h"
#include "base/propagate.h"

namespace algebra3d::detail {

/// Checks that numbers are finite. Errors: invalid_value, beginning with `what`.
Status check_finite(std::string_view what, const Vec3& numbers);

/// The triangles of a mesh, each coordinate rounded to the nearest double.
IndexedTriangles rounded_triangles(const TriangleMesh& mesh);

/// A mesh of a user's triangles; equal points are welded. Errors: invalid_value for coordinates that are not finite and
/// for invalid indices.
Result<TriangleMesh> welded_mesh(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles);

/// A surface3d or volume3d of a user's triangles. Errors: also invalid_value, with the defects, if they are not valid;
/// interrupted.
template <typename T>
Result<T> proved(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles,
                 const Monitor& monitor) {
  A3D_ASSIGN(TriangleMesh mesh, welded_mesh(points, triangles));
  A3D_ASSIGN(auto value, T::prove(std::move(mesh), {.cancel = monitor.cancel()}));
  if (!value) return Error{ErrorCode::invalid_value, value.reason()};
  return *std::move(value);
}

}  // namespace algebra3d::detail
