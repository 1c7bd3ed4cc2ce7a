#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/valid_parts.h"

namespace algebra3d {

/// Says whether a solid holds the places with a winding number; never those with 0.
using WindingRule = std::function<bool(int winding)>;

/// The solid of the places whose winding number about `mesh` the rule keeps, as a valid volume. The mesh may pass
/// through itself, lie upon itself, repeat triangles and have degenerate ones, but it must be closed: along every line
/// as many triangles run one way as the other, those counted apart in which an edge is divided.
/// Vertices are those of the mesh, or the exact points in which three of its planes meet.
/// Exactness: exact. Errors: interrupted, limit_exceeded. Deterministic. Cost: that of a proof, and of an arrangement
/// of the triangles that touch others in more than an edge.
///
/// `max_pairs` limits the pairs of triangles that may touch, beyond which it is limit_exceeded: folded meshes may have
/// as many as the square of their triangles.
Result<TriangleMesh> winding_solid(const TriangleMesh& mesh, const WindingRule& rule, const Monitor& monitor = {},
                                   const ArrangementOptions& limits = {});
/// The same for a mesh that is in parts already.
Result<TriangleMesh> winding_solid(const ValidParts& parts, const WindingRule& rule, const Monitor& monitor = {},
                                   const ArrangementOptions& limits = {});

}  // namespace algebra3d
