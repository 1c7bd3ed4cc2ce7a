#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Faces at which a mesh is not a valid surface: those that cross others, and degenerate ones; empty if it is one.
/// Exact. Errors: interrupted. Cost: that of prove_surface.
Result<std::vector<FaceId>> defects_of_surface(const TriangleMesh& mesh, const Monitor& monitor);
/// Faces at which a mesh is not a valid volume: as for surfaces, and those of shells on the wrong side of others.
Result<std::vector<FaceId>> defects_of_volume(const TriangleMesh& mesh, const Monitor& monitor);

/// Locks the vertices of `before` that were merged into corners of `defects`, faces of `after`, and those around them:
/// the more steps of neighbours, the later the round. `images`: the vertex of `after` for each vertex. `locked` is
/// empty or has a flag for each; at least one more is set afterwards.
void lock_around(const TriangleMesh& before, const TriangleMesh& after, std::span<const std::uint32_t> images,
                 std::span<const FaceId> defects, std::size_t round, std::vector<std::uint8_t>& locked);

}  // namespace algebra3d
