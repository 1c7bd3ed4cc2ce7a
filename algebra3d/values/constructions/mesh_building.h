#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/values/types/mesh3d.h"

namespace algebra3d {

// Meshes that are built step by step. Attributes are kept; those of new elements are undefined. Cost: linear in the
// mesh.

/// With a vertex, the last one.
Mesh3d with_vertex(const Mesh3d& mesh, const PointRef& point);
/// With a face, the last one. Undefined for fewer than three corners, and for numbers that are not vertices. Errors:
/// limit_exceeded.
Result<Maybe<Mesh3d>> with_face(const Mesh3d& mesh, std::span<const std::int64_t> corners);
/// Without a face; later faces are renumbered, vertices stay. Undefined for a number that is not a face.
Maybe<Mesh3d> without_face(const Mesh3d& mesh, std::int64_t face);

}  // namespace algebra3d
