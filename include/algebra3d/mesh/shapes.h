#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/geometry/solid.h"
#include "algebra3d/geometry/surface.h"
#include "algebra3d/mesh/mesh.h"

/// Meshes and the exact shapes of algebra3d::geometry.
namespace algebra3d::mesh {

/// The triangles of a shape, with its exact coordinates: see Mesh::has_fractions. Shares the arrays. Cost: linear, for
/// the numbers of the edges.
TriangleMesh mesh_of(const Solid& solid);
TriangleMesh mesh_of(const Surface& surface);

/// The solid that a mesh bounds, exactly. Equal points are welded, polygons are triangulated; nothing is repaired.
/// Errors: invalid_value, with the defects, if it bounds none; limit_exceeded; interrupted. Cost: n log n, a proof.
template <AnyMesh M>
Result<Solid> solid_of(const M& mesh, const Monitor& monitor = {});
/// The surface of the faces of a mesh. Errors: also invalid_value if faces cross or overlap.
template <AnyMesh M>
Result<Surface> surface_of(const M& mesh, const Monitor& monitor = {});

}  // namespace algebra3d::mesh
