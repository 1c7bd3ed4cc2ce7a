#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

/// The nine adjacency relations between vertices, edges and faces, as lists in which each element is once; for ranges
/// without allocation see circulators.h. An edge is given by its first half-edge (`first_along`). Elements that are
/// passed must be valid in the mesh. Cost: linear in the answer, expected, for the edges and vertices beside an edge in
/// the number of faces at its ends.
namespace algebra3d {

/// The other ends of the edges at `v`, fan by fan, counter-clockwise. A face that repeats a corner may make `v` its own
/// neighbour.
template <typename Layout>
std::vector<VertexId> vertices_beside(const HalfedgeMesh<Layout>& mesh, VertexId v);
/// The edges at `v`, in the same order.
template <typename Layout>
std::vector<HalfedgeId> edges_at(const HalfedgeMesh<Layout>& mesh, VertexId v);
/// The faces at `v`, in the same order.
template <typename Layout>
std::vector<FaceId> faces_at(const HalfedgeMesh<Layout>& mesh, VertexId v);
/// Number of edges at `v`. Cost: that of the edges; no allocation where all of them are manifold or boundary.
template <typename Layout>
std::size_t valence(const HalfedgeMesh<Layout>& mesh, VertexId v);

/// The ends of an edge: origin and target of its first half-edge.
template <typename Layout>
std::vector<VertexId> vertices_of_edge(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge);
/// The edges that share an end with an edge: first those at its origin, then those at its target.
template <typename Layout>
std::vector<HalfedgeId> edges_beside(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge);
/// The faces along an edge, in order of their half-edges.
template <typename Layout>
std::vector<FaceId> faces_along(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge);

/// The corners of a face, from corner 0.
template <typename Layout>
std::vector<VertexId> vertices_of_face(const HalfedgeMesh<Layout>& mesh, FaceId f);
/// The edges of a face, from corner 0.
template <typename Layout>
std::vector<HalfedgeId> edges_of_face(const HalfedgeMesh<Layout>& mesh, FaceId f);
/// The other faces along the edges of a face, edge by edge from corner 0.
template <typename Layout>
std::vector<FaceId> faces_beside(const HalfedgeMesh<Layout>& mesh, FaceId f);

}  // namespace algebra3d
