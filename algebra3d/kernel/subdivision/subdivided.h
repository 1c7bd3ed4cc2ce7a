#pragma once

#include <cstddef>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/scheme.h"

namespace algebra3d {

struct SubdivisionOptions {
  std::size_t variant = 0;  ///< the place among the variants of the scheme (scheme.h); the first is the default
};

/// The mesh after some steps of a subdivision scheme; after none, or without faces, the mesh itself. Coordinates are
/// rounded to doubles first, and the result has doubles. The boundary of the result depends on the boundary of the mesh
/// alone; the rules there are in `docs/halfedge.md`, Subdivision. Isolated vertices stay where they are; Doo-Sabin
/// drops them. Numbers: vertices of the mesh keep theirs; then come new vertices in the order of edges (each at its
/// first half-edge), then those in the order of faces. The faces made of one face follow each other. Doo-Sabin has a
/// vertex per half-edge, then two per boundary edge, at its origin and its target; faces in the order of faces, then of
/// edges, then of vertices. With sqrt3 new vertices are in the order of faces, and triangles in that of the half-edges
/// of the mesh. Domain: manifold meshes; triangles for Loop, Butterfly and sqrt3. Exactness: doubles throughout; in
/// each step the error is below (n + 16) 2^-52 times the largest coordinate of the mesh, with n the largest number of
/// edges at a vertex or of corners of a face. Errors: invalid_value for meshes that the scheme cannot take;
/// limit_exceeded, before work begins, if the result would have too many half-edges or a coordinate is beyond 2^960;
/// interrupted. Cost: linear in the result, on all processors; the result does not depend on their number.
Result<PolygonMesh> subdivided(const PolygonMesh& mesh, const SubdivisionScheme& scheme, std::size_t steps,
                               const SubdivisionOptions& options = {}, const Monitor& monitor = {});

struct SubdividedMesh {
  PolygonMesh mesh;
  MeshAttributes attributes;
};

/// Subdivides a mesh with attributes.
/// Numbers of vertices have the weights of the scheme, as coordinates have: an attribute that equals the coordinates
/// stays equal. They are undefined where an undefined one has a part in them.
/// Numbers of corners have the means of corners of the same face, so that seams stay, and corners keep theirs: linear
/// interpolation, also where the scheme smooths the points. Doo-Sabin has its own weights, which are within a face;
/// sqrt3, whose triangles lie in two faces, the mean of both.
/// Numbers of faces: those of the face that the new one was made of, or the mean if it was made of several. Texts: the
/// text that all vertices, corners or faces in question have.
/// Halves and thirds of edges have the values of the edge; new edges, and all of Doo-Sabin, have none.
/// Creases: schemes that honour them read the sharpness of edges and vertices, 0 or more, undefined being 0, in the
/// real attributes `Crease` of edges and `Corner` of vertices. A sharpness s holds for s steps, a fraction for a part
/// of one, and from 10 on for all; the attributes of the result have what is left. Two sharp edges at a vertex make a
/// cubic B-spline curve, one a dart, more a corner, also with edges of the boundary. Source: [derose1998].
/// Errors: besides, invalid_value for a sharpness below 0 or attributes of these names that are not real.
/// Cost: linear; each attribute of vertices takes a step of its own, other attributes one processor.
Result<SubdividedMesh> subdivided(const PolygonMesh& mesh, const MeshAttributes& attributes,
                                  const SubdivisionScheme& scheme, std::size_t steps,
                                  const SubdivisionOptions& options = {}, const Monitor& monitor = {});

/// The mesh with its vertices where they move to when it is subdivided without end: on the limit surface, and at the
/// boundary on the limit curve, a cubic B-spline, or with Doo-Sabin a quadratic one. Doo-Sabin makes a face of a
/// vertex, whose corners have one limit. Domain: schemes with a limit (`has_limit`, asserted), other than Doo-Sabin's
/// rule `open` at the boundary; else, exactness and errors as above. Sources: [halstead1993] for Catmull-Clark,
/// [loop1987] for Loop; for Doo-Sabin the mean of a face, since every step keeps it.
Result<PolygonMesh> limit_mesh(const PolygonMesh& mesh, const SubdivisionScheme& scheme,
                               const SubdivisionOptions& options = {}, const Monitor& monitor = {});
/// As above with attributes: numbers of vertices move with the points, others stay. Creases are honoured: where a
/// sharpness is neither 0 nor infinite, steps are made until it is, at the cost of their results.
Result<SubdividedMesh> limit_mesh(const PolygonMesh& mesh, const MeshAttributes& attributes,
                                  const SubdivisionScheme& scheme, const SubdivisionOptions& options = {},
                                  const Monitor& monitor = {});

}  // namespace algebra3d
