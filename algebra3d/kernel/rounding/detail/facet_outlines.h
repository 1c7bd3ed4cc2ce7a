#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/coplanar_facets.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/edge_chains.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"
#include "base/indices.h"

namespace algebra3d {

/// A chain as a part of the outline of a facet, which lies to its left.
struct OutlineChain {
  CoplanarFacetId facet;
  ChainId chain;
  bool is_reversed;  ///< the outline runs from the end of the chain to its start
};

/// A link of the outline of a facet.
struct OutlineLink {
  CoplanarFacetId facet;
  ChainLink link;
};

/// The links of the outline of a facet, as pairs of points.
struct FacetOutline {
  std::vector<DirectedEdge> boundary;  ///< without pairs of opposite links; ascending by their ends
  /// Edges with the facet on both sides, as where another sheet ends within it: each link in both directions. None is a
  /// link of the boundary.
  std::vector<DirectedEdge> slits;

  void reverse();
};

/// The outlines of the coplanar facets of a mesh of which vertices have moved: an outline is made of chains, a chain of
/// links (edge_chains.h). Edges that lie upon each other now are one chain. Chains lead through every point that their
/// edge may have passed over, for all facets along it. Where two links of one outline still cross, one of them is led
/// through the nearest end of the other, in a few rounds. Source: the hot pixels of [hobby1999], here about segments in
/// space.
class FacetOutlines {
 public:
  /// The mesh must outlive this. If `monitor` is cancelled, the outlines mean nothing. Cost: n log n.
  FacetOutlines(const TriangleMesh& mesh, const MovedVertices& moved, const Monitor& monitor);

  const CoplanarFacets& facets() const { return facets_; }
  const MovedPoints& points() const { return points_; }
  const EdgeChains& chains() const { return chains_; }
  EdgeChains& chains() { return chains_; }
  /// The chains of all outlines, facet by facet, and those of one outline.
  const std::vector<OutlineChain>& outline_chains() const { return outline_chains_; }
  std::span<const OutlineChain> outline_chains(CoplanarFacetId facet) const;

  /// True if a point of the facet has moved.
  bool is_moved(CoplanarFacetId facet) const { return is_moved_[facet]; }
  /// False if the outline may still cross itself.
  bool is_simple(CoplanarFacetId facet) const { return !is_given_up_[facet] && !to_check_[facet]; }
  FacetOutline outline(CoplanarFacetId facet) const;
  /// The corners of a face of the mesh, as points.
  IndexTriangle triangle(FaceId face) const;
  /// The orientation of three points in the projection: 1 counter-clockwise, -1 clockwise, 0 collinear. Exact.
  int orientation(Projection plane, PointId a, PointId b, PointId c) const {
    return orient2d(plane, points_.table[a.index()], points_.table[b.index()], points_.table[c.index()]);
  }

 private:
  void note_movements(const MovedVertices& moved);
  void find_outline_chains();
  std::size_t link_count(CoplanarFacetId facet) const;
  void add_links(const OutlineChain& side, std::vector<DirectedEdge>& links) const;
  /// Applies the pending insertions into chains. False if there are none.
  bool apply_routes();
  /// The links of changed outlines. Outlines that have grown too much are given up.
  std::vector<OutlineLink> links_to_check();
  void route_around_crossings(const Monitor& monitor);

  const TriangleMesh& mesh_;
  CoplanarFacets facets_;
  MovedPoints points_;
  EdgeChains chains_;
  std::vector<OutlineChain> outline_chains_;  // facet by facet
  IdVector<CoplanarFacetId, std::size_t> first_side_;
  IdVector<CoplanarFacetId, bool> is_moved_;
  IdVector<CoplanarFacetId, bool> is_given_up_;  // the outline may cross itself forever
  IdVector<CoplanarFacetId, bool> to_check_;
  IdVector<CoplanarFacetId, std::size_t> first_link_counts_;
};

/// Directed edges without pairs of opposite edges; ascending by their ends.
std::vector<DirectedEdge> without_opposites(std::vector<DirectedEdge> edges);

}  // namespace algebra3d
