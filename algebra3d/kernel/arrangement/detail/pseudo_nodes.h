#pragma once

#include <compare>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/region_edges.h"
#include "algebra3d/kernel/arrangement/detail/result_mesh.h"

namespace algebra3d::arrangement {

/// A pseudo-node: a node in the middle of a straight edge of a region, on the way from one node to the next, at which
/// the region needs no corner for that edge. The same node may be a corner of another edge or region.
struct PseudoNode {
  NodeId node;
  RegionKey region;
  NodeId before, after;

  auto place() const { return std::tie(node, region); }
  friend auto operator<=>(const PseudoNode&, const PseudoNode&) = default;
};

/// All pseudo-nodes of all regions, ascending. A node on a straight line is a pseudo-node if the same regions lie along
/// the line before and behind it, and each is half a disc round the node (docs/set-operations.md, "Minimal results").
/// On an uncut edge all nodes between its ends are pseudo-nodes, since the patch has the edge whole. Its ends are not,
/// if a face that is taken over has a corner there (`patch_corners`): the patch ends its edge there, too. Other edges
/// may be led straight past such a corner. Exact. Cost: near-linear in the edges.
std::vector<PseudoNode> find_pseudo_nodes(const Subdivision& subdivision, const std::vector<RegionEdge>& edges,
                                          const PatchCorners& patch_corners);

/// Every violated invariant, one sentence each: pseudo-nodes ascend; each lies between its neighbours, straight on; a
/// straight edge that comes from one node goes on to one. Cost: linear, with exact predicates.
std::vector<std::string> audit(const Subdivision& subdivision, const std::vector<PseudoNode>& pseudo_nodes);

/// Replaces runs of edges through pseudo-nodes by one edge each. Gives the edges ascending, region by region.
std::vector<RegionEdge> straightened(std::vector<RegionEdge> edges, std::span<const PseudoNode> pseudo_nodes);

}  // namespace algebra3d::arrangement
