#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/arrangement/triangulation.h"
#include "algebra3d/arrangement/vertex_pool.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/edge_chains.h"
#include "algebra3d/repair/mesh_facets.h"

namespace algebra3d {

/// New places of the vertices of a mesh, and how far each is, at most, from the old one.
struct MovedVertices {
  PointArray points;
  std::vector<double> movements;
};

/// Points by numbers that equal points share.
struct MovedPoints {
  explicit MovedPoints(const MovedVertices& moved);

  arrangement::VertexPool pool;
  std::vector<Vec3> points;            // per number, rounded
  std::vector<double> movements;       // per number, the largest
  std::vector<std::uint32_t> numbers;  // per vertex
  double largest_movement = 0;
};

/// An edge as part of the boundary of a facet, which lies to its left.
struct BoundaryEdge {
  std::uint32_t facet, edge;
  bool is_reversed;  ///< runs from the end of the chain to its start
};

/// The outlines of the facets of a mesh of which vertices have moved. Edges that lie upon each other now are one. A
/// vertex that an edge may have passed over on its way has become a corner of that edge, in all facets along it, and so
/// has, where two links of one outline crossed, the end of one that was nearest to the other; up to a few rounds.
/// Source: the hot pixels of [hobby1999], here about segments in space.
class FacetOutlines {
 public:
  FacetOutlines(const TriangleMesh& mesh, const MovedVertices& moved);

  const MeshFacets& facets() const { return facets_; }
  const arrangement::VertexPool& points() const { return points_.pool; }
  const EdgeChains& edges() const { return edges_; }
  std::span<const BoundaryEdge> boundary(std::uint32_t facet) const {
    return std::span(boundary_).subspan(first_of_facet_[facet], first_of_facet_[facet + 1] - first_of_facet_[facet]);
  }

  /// Something of the facet is not where it was.
  bool is_moved(std::uint32_t facet) const { return is_moved_[facet]; }
  /// False if the outline may cross itself still.
  bool is_simple(std::uint32_t facet) const { return !is_tangled_[facet] && !to_check_[facet]; }
  /// The links of the outline that no other runs along in the opposite direction, ascending.
  std::vector<arrangement::DirectedEdge> outline(std::uint32_t facet) const;
  /// The corners of a triangle of the mesh, as numbers of points.
  TriangleMesh::Triangle triangle(std::uint32_t face) const;
  /// In the direction of the projection: the sign of the area of the triangle of these points.
  int turn(Projection plane, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orient2d(plane, points_.pool[a], points_.pool[b], points_.pool[c]);
  }

 private:
  void find_facets(const MovedVertices& moved);
  void find_edges();
  void touch_along(std::span<const std::uint32_t> edges);
  void lead_through_passed_vertices();
  bool lead_around_crossings();
  void lead(std::uint32_t facet, ChainLink link, std::uint32_t vertex);
  bool lead_through_inner_end(std::uint32_t facet, ChainLink link, ChainLink crossing);
  void resolve(std::uint32_t facet, ChainLink one, ChainLink other);
  std::size_t link_count(std::uint32_t facet) const;

  const TriangleMesh& mesh_;
  MeshFacets facets_;
  MovedPoints points_;
  EdgeChains edges_;
  std::vector<BoundaryEdge> boundary_;  // facet by facet
  std::vector<std::uint32_t> first_of_facet_;
  std::vector<bool> is_moved_;                  // per facet
  std::vector<bool> is_tangled_;                // per facet: its outline may cross itself for ever
  std::vector<bool> to_check_;                  // per facet
  std::vector<std::size_t> first_link_counts_;  // per facet
};

/// What is left of directed edges, ascending, when those that run along each other in opposite directions are gone.
std::vector<arrangement::DirectedEdge> without_opposites(std::vector<arrangement::DirectedEdge> edges);

}  // namespace algebra3d
