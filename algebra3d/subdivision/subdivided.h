#pragma once

#include <cstddef>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/polygon_mesh.h"
#include "algebra3d/subdivision/scheme.h"

namespace algebra3d {

struct SubdivisionOptions {
  LoopWeights loop_weights = LoopWeights::loop;
};

/// The mesh after some steps of a subdivision scheme; after none, the mesh itself. Coordinates are rounded to doubles
/// first, and the result has doubles. Every rule for vertices at the boundary depends on the boundary alone, except
/// that Doo-Sabin makes no faces at the boundary (see `docs/halfedge.md`, Subdivision). Isolated vertices stay where
/// they are; Doo-Sabin drops them.
/// Numbers: vertices of the mesh keep theirs; then come new vertices in the order of edges (each at its first
/// half-edge), then those in the order of faces. The faces made of one face follow each other. Doo-Sabin has a vertex
/// per half-edge, and faces in the order of faces, then of interior edges, then of interior vertices.
/// Domain: manifold meshes; triangles for Loop and Butterfly.
/// Exactness: each coordinate within a few units in the last place of the masks of the source.
/// Errors: invalid_value for meshes that the scheme cannot take; limit_exceeded, before work begins, if the result
/// would have too many half-edges or a coordinate is beyond 2^960; interrupted.
/// Cost: linear in the result, on all processors; the result does not depend on their number.
Result<PolygonMesh> subdivided(const PolygonMesh& mesh, SubdivisionScheme scheme, std::size_t steps,
                               const SubdivisionOptions& options = {}, const Monitor& monitor = {});

/// The mesh with its vertices where they move to when it is subdivided without end: on the limit surface, and at the
/// boundary on the limit curve, a cubic B-spline. For Catmull-Clark and Loop only (asserted).
/// Domain, exactness, errors: as above. Sources: [halstead1993] for Catmull-Clark, [loop1987] for Loop.
Result<PolygonMesh> limit_mesh(const PolygonMesh& mesh, SubdivisionScheme scheme,
                               const SubdivisionOptions& options = {}, const Monitor& monitor = {});

}  // namespace algebra3d
