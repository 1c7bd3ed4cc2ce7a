#pragma once

#include <cstddef>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/scheme.h"

namespace algebra3d {

struct SubdivisionOptions {
  LoopWeights loop_weights = LoopWeights::loop;
};

/// The mesh after some steps of a subdivision scheme; after none, or without faces, the mesh itself. Coordinates are
/// rounded to doubles first, and the result has doubles. The boundary of the result depends on the boundary of the mesh
/// alone, except that Doo-Sabin makes no faces at the boundary; all rules there are in `docs/halfedge.md`, Subdivision.
/// Isolated vertices stay where they are; Doo-Sabin drops them.
/// Numbers: vertices of the mesh keep theirs; then come new vertices in the order of edges (each at its first
/// half-edge), then those in the order of faces. The faces made of one face follow each other. Doo-Sabin has a vertex
/// per half-edge, and faces in the order of faces, then of interior edges, then of interior vertices.
/// Domain: manifold meshes; triangles for Loop and Butterfly.
/// Exactness: doubles throughout; in each step the error is below (n + 16) 2^-52 times the largest coordinate of the
/// mesh, with n the largest number of edges at a vertex or of corners of a face.
/// Errors: invalid_value for meshes that the scheme cannot take; limit_exceeded, before work begins, if the result
/// would have too many half-edges or a coordinate is beyond 2^960; interrupted.
/// Cost: linear in the result, on all processors; the result does not depend on their number.
Result<PolygonMesh> subdivided(const PolygonMesh& mesh, SubdivisionScheme scheme, std::size_t steps,
                               const SubdivisionOptions& options = {}, const Monitor& monitor = {});

struct SubdividedMesh {
  PolygonMesh mesh;
  MeshAttributes attributes;
};

/// Subdivides a mesh with attributes. Faces have the values of the face that they were made of, halves of edges those
/// of the edge. The values of vertices and of corners are interpolated linearly: a vertex in an edge or face has the
/// mean of those of its corners, and a vertex that moves keeps its values; so do corners, face by face, so that seams
/// stay. Only the edges within faces have none. Doo-Sabin: a vertex has the mean of a corner, of the middles of the
/// edges beside it, and of that of the face; faces for edges and vertices have the mean of the faces around, edges have
/// none. The mean of texts is the text that all have. Cost: linear besides, on one processor.
Result<SubdividedMesh> subdivided(const PolygonMesh& mesh, const MeshAttributes& attributes, SubdivisionScheme scheme,
                                  std::size_t steps, const SubdivisionOptions& options = {},
                                  const Monitor& monitor = {});

/// The mesh with its vertices where they move to when it is subdivided without end: on the limit surface, and at the
/// boundary on the limit curve, a cubic B-spline. For Catmull-Clark and Loop only (asserted).
/// Domain, exactness, errors: as above. Sources: [halstead1993] for Catmull-Clark, [loop1987] for Loop.
Result<PolygonMesh> limit_mesh(const PolygonMesh& mesh, SubdivisionScheme scheme,
                               const SubdivisionOptions& options = {}, const Monitor& monitor = {});

}  // namespace algebra3d
