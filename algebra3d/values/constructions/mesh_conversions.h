#pragma once

#include <cstdint>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/values/types/mesh3d.h"

namespace algebra3d {

/// Whether the triangles of a value are taken as they are, or joined to polygons.
enum class Merging : std::uint8_t { none, coplanar_facets };

/// A triangle mesh as polygons, with the vertices in their order, without those that no face uses.
/// `coplanar_facets`: triangles in one plane that are connected across manifold edges become one polygon, at the place
/// of the first of them, if their boundary is one loop that meets no vertex twice; so facets with holes stay
/// triangulated. Vertices within a polygon go, and so do those in the middle of a straight line between only two
/// polygons, or on the boundary. Exact. Errors: interrupted. Cost: linear.
Result<PolygonMesh> polygon_mesh_of(const TriangleMesh& mesh, Merging merging, const Monitor& monitor = {});

/// The faces as triangles (soup/mesh_triangulation.h), with equal vertices welded: the mesh of the proof of a surface
/// or solid. Errors: interrupted, limit_exceeded.
Result<TriangleMesh> welded_triangles_of(const PolygonMesh& mesh, const Monitor& monitor = {});

/// The faces as triangles, with the vertices of the mesh. Attributes are kept: triangles have those of their face, and
/// edges within a face have none. Errors: interrupted.
Result<Mesh3d> triangulated(const Mesh3d& mesh, const Monitor& monitor = {});

}  // namespace algebra3d
