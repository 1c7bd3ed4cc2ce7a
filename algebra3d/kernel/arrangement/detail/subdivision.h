#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/detail/patches.h"
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"
#include "algebra3d/kernel/arrangement/operand.h"

namespace algebra3d::arrangement {

/// An uncut edge: an edge of an operand between a patch and a facet. No other operand touches it. Its own operand may,
/// with a corner or an edge; then it is divided into several space edges. The patch has it whole, so every result that
/// takes the patch has, too.
struct UncutEdge {
  InputEdgeId edge;
  Slice nodes;  ///< of UncutEdges::nodes: those along the segment of the edge, in its direction
};

/// A set of space edges, which is asked for every space edge several times, and where each stands in the list of which
/// it was made. Constant once it is made.
class SpaceEdgeSet {
 public:
  SpaceEdgeSet() = default;
  /// `edges`: each once. Cost: linear in these and in the nodes.
  SpaceEdgeSet(std::span<const SpaceEdge> edges, std::size_t node_count);

  bool contains(const SpaceEdge& edge) const { return position(edge) != kNone; }
  /// The position of the edge in the list; kNone if it is not a member. Cost: that of the members with the same
  /// first node.
  std::uint32_t position(const SpaceEdge& edge) const {
    if (ends_.empty()) return kNone;
    for (std::uint32_t i = begins_[edge.u.index()]; i < begins_[edge.u.index() + std::size_t{1}]; ++i)
      if (ends_[i].v == edge.v) return ends_[i].position;
    return kNone;
  }

 private:
  struct End {
    NodeId v;
    std::uint32_t position = 0;
  };

  std::vector<std::uint32_t> begins_;  // of ends_: per first node, and where all end
  std::vector<End> ends_;
};

/// All uncut edges.
struct UncutEdges {
  std::vector<UncutEdge> edges;  ///< in the order of their segments
  std::vector<NodeId> nodes;     ///< edge by edge
  SpaceEdgeSet space_edges;      ///< those along them: where patches end
  /// The edge, by its number, along which each of `space_edges` lies.
  std::vector<std::uint32_t> edge_at;

  /// The uncut edge along which a space edge lies, or null.
  const UncutEdge* find(const SpaceEdge& edge) const {
    const std::uint32_t position = space_edges.position(edge);
    return position == kNone ? nullptr : &edges[edge_at[position]];
  }
  std::span<const NodeId> nodes_along(const UncutEdge& edge) const { return edge.nodes.of(nodes); }
};

/// Operands divided at one another: the output of stages 0 to 7.
struct Subdivision {
  Operands operands;
  Facets facets;
  SegmentComplex complex;
  SubEdges sub_edges;
  Patches patches;
  UncutEdges uncut_edges;

  const Plane& plane_of(SubEdgeId sub_edge) const { return facets.planes[sub_edges[sub_edge].plane]; }
  /// Calls visit(first, patch) with the patches of the faces at an uncut edge, and that of the first of them.
  template <typename Visit>
  void for_each_patch_at(const UncutEdge& edge, const Visit& visit) const {
    PatchId first;
    std::vector<InputHalfedgeId> along;
    operands.halfedges_along(edge.edge, along);
    for (const InputHalfedgeId h : along) {
      const PatchId patch = patches.of_face[Operands::face(h)];
      if (patch.is_none()) continue;
      if (first.is_none()) first = patch;
      visit(first, patch);
    }
  }
};

/// Whether operands have boundaries: `none` for solids (Closure::each), `possible` for surfaces and for
/// Closure::together. Along a boundary the facets that hold a sub-edge have to be searched for (incident_facets.h).
enum class Boundaries : std::uint8_t { none, possible };

/// Runs stages 0 to 7. The list of operands, their meshes and the hierarchies given with them must outlive the result.
/// Exact. Errors: interrupted; limit_exceeded beyond a limit of the options; internal as find_facet_contacts. Cost:
/// near-linear in the faces of operands whose boxes meet, linear in those of the others.
Result<Subdivision> subdivide(std::span<const Operand> list, Boundaries boundaries, const ArrangementOptions& options,
                              const Monitor& monitor);

}  // namespace algebra3d::arrangement
