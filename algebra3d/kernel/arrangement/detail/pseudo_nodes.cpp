#include "algebra3d/kernel/arrangement/detail/pseudo_nodes.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/arrangement/detail/bucket_sort.h"
#include "algebra3d/kernel/arrangement/detail/numbers_by_bucket.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/equal_span.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// A boundary edge of a region as one of its ends sees it.
struct EdgeEnd {
  NodeId node, other;
  RegionKey region;
  bool is_outgoing;
};

/// The ends of all edges, node by node; each is twice the number of its edge, and one more for its target. Four bytes
/// an end, and EdgeEnds are made at one node at a time: where operands nearly coincide all edges are edges of regions.
class EndsOfNodes {
 public:
  EndsOfNodes(const std::vector<RegionEdge>& edges, std::size_t node_count)
      : edges_(edges), by_node_(2 * edges.size(), node_count, [&](std::size_t end) {
          return (end % 2 == 0 ? edges[end / 2].from : edges[end / 2].to).index();
        }) {}

  std::size_t node_count() const { return by_node_.bucket_count(); }
  /// Appends the ends at a node, in no order.
  void collect(NodeId node, std::vector<EdgeEnd>& ends) const {
    for (const std::uint32_t end : by_node_.of(node.index())) {
      const RegionEdge& edge = edges_[end / 2];
      const bool is_outgoing = end % 2 == 0;
      ends.push_back({node, is_outgoing ? edge.to : edge.from, edge.region, is_outgoing});
    }
  }

 private:
  const std::vector<RegionEdge>& edges_;
  NumbersByBucket by_node_;
};

/// Edge ends at one node. The edges of all regions that lead from there to one other node are an *arm*.
using EdgeEnds = std::span<const EdgeEnd>;

using ArmId = StrongId<struct ArmTag>;

/// An edge end at the node at hand, and its arm; none if that is left out.
struct EndOfArm {
  EdgeEnd end;
  ArmId arm;

  RegionKey region() const { return end.region; }
};

class PseudoNodeFinder {
 public:
  PseudoNodeFinder(const Subdivision& subdivision, const PatchCorners& patch_corners)
      : subdivision_(subdivision), patch_corners_(patch_corners) {}

  void find_between(const std::vector<RegionEdge>& edges);
  void find_along(const UncutEdge& edge);
  std::vector<PseudoNode> take();

 private:
  std::vector<PseudoNode> found_at_nodes(const EndsOfNodes& ends, std::size_t begin, std::size_t end) const;
  void find_at_node(EdgeEnds ends);
  void find_arms(EdgeEnds ends);
  bool is_straight(NodeId before, NodeId node, NodeId after) const;
  std::span<const EndOfArm> ends_of(RegionKey region) const;
  bool continue_each_other(ArmId one, ArmId other) const;
  bool is_half_disc(const EdgeEnd& end, NodeId opposite) const;
  void add_along(std::span<const NodeId> nodes, PlaneId plane, bool is_forward);

  const Subdivision& subdivision_;
  const PatchCorners& patch_corners_;
  std::vector<PseudoNode> found_;
  // At the node at hand; members, so that their memory is used again.
  std::vector<EdgeEnds> arms_;
  std::vector<EndOfArm> by_region_;  // all ends: at the tip of a cone there are many, few of each region
};

/// The order of the ends at one node.
bool is_less_at_node(const EdgeEnd& a, const EdgeEnd& b) {
  if (a.other != b.other) return a.other < b.other;
  if (a.region != b.region) return a.region < b.region;
  return a.is_outgoing < b.is_outgoing;
}

void PseudoNodeFinder::find_between(const std::vector<RegionEdge>& edges) {
  const EndsOfNodes ends(edges, subdivision_.complex.nodes.size());
  found_ = parallel_collect(ends.node_count(), kNodesPerTask,
                            [&](std::size_t begin, std::size_t end) { return found_at_nodes(ends, begin, end); });
}

/// At the nodes in a range.
std::vector<PseudoNode> PseudoNodeFinder::found_at_nodes(const EndsOfNodes& ends, std::size_t begin,
                                                         std::size_t end) const {
  PseudoNodeFinder part(subdivision_, patch_corners_);
  std::vector<EdgeEnd> at_node;
  for (std::size_t node = begin; node < end; ++node) {
    at_node.clear();
    ends.collect(NodeId(node), at_node);
    std::ranges::sort(at_node, is_less_at_node);
    if (!at_node.empty()) part.find_at_node(at_node);
  }
  return std::move(part.found_);
}

/// The edge of a patch is whole or ends at the patch's corner, as the patch has it: there it is not an arm.
void PseudoNodeFinder::find_arms(EdgeEnds ends) {
  const bool is_corner = patch_corners_.is_corner(ends[0].node);
  arms_.clear();
  by_region_.clear();
  for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
    while (last < ends.size() && ends[last].other == ends[first].other) ++last;
    const SpaceEdge line = SpaceEdge::of(ends[first].node, ends[first].other);
    const bool is_arm = !is_corner || !subdivision_.uncut_edges.space_edges.contains(line);
    const ArmId arm = is_arm ? ArmId(arms_.size()) : ArmId();
    if (is_arm) arms_.push_back(ends.subspan(first, last - first));
    for (const EdgeEnd& end : ends.subspan(first, last - first)) by_region_.push_back({end, arm});
  }
  std::ranges::sort(by_region_, {},
                    [](const EndOfArm& e) { return std::tuple(e.region(), e.end.other, e.end.is_outgoing); });
}

std::span<const EndOfArm> PseudoNodeFinder::ends_of(RegionKey region) const {
  return equal_span(std::span<const EndOfArm>(by_region_), region, &EndOfArm::region);
}

void PseudoNodeFinder::find_at_node(EdgeEnds ends) {
  find_arms(ends);
  for (std::size_t i = 0; i < arms_.size(); ++i)
    for (const auto& [end, arm] : ends_of(arms_[i][0].region)) {
      if (arm.is_none() || arm <= ArmId(i) || end.is_outgoing == arms_[i][0].is_outgoing) continue;
      const NodeId from = arms_[i][0].other, to = end.other;
      if (!continue_each_other(ArmId(i), arm) || !is_straight(from, end.node, to)) continue;
      for (const EdgeEnd& e : arms_[i])
        found_.push_back({e.node, e.region, e.is_outgoing ? to : from, e.is_outgoing ? from : to});
    }
}

bool PseudoNodeFinder::is_straight(NodeId before, NodeId node, NodeId after) const {
  const NodePool& nodes = subdivision_.complex.nodes;
  return compare(nodes[before], nodes[node]) == compare(nodes[node], nodes[after]) &&
         collinear(nodes[before], nodes[node], nodes[after]);
}

/// True if the boundaries of all regions that come along one arm leave along the other, and each region is half a disc
/// at the node, on its side of the line: then none of them needs the node as a corner. Anything else there, also of the
/// same regions, touches the straight edge in a point.
bool PseudoNodeFinder::continue_each_other(ArmId one, ArmId other) const {
  const EdgeEnds first = arms_[one.index()], second = arms_[other.index()];
  if (first.size() != second.size()) return false;
  const auto continues = [&](const EdgeEnd& end) {
    return std::ranges::count_if(ends_of(end.region), [&](const EndOfArm& e) {
             return e.arm == other && e.end.is_outgoing != end.is_outgoing;
           }) == 1;
  };
  return std::ranges::all_of(first, continues) &&
         std::ranges::all_of(first, [&](const EdgeEnd& end) { return is_half_disc(end, second[0].other); });
}

/// `opposite` is the other end of the second arm. True if no other boundary edge of the region ends at the node on the
/// side of the line where the region lies along the edge.
bool PseudoNodeFinder::is_half_disc(const EdgeEnd& end, NodeId opposite) const {
  const NodePool& nodes = subdivision_.complex.nodes;
  const Projection projection = subdivision_.facets.planes[end.region.plane()].projection;
  return std::ranges::none_of(ends_of(end.region), [&](const EndOfArm& of_region) {
    const EdgeEnd& e = of_region.end;
    if (e.other == end.other || e.other == opposite) return false;
    const int turn = orient2d(projection, nodes[end.node], nodes[end.other], nodes[e.other]);
    return (turn > 0) == end.is_outgoing;
  });
}

/// Where a patch ends, its edge is whole; so it has to be whole in the regions on its other sides.
void PseudoNodeFinder::find_along(const UncutEdge& edge) {
  const auto nodes = subdivision_.uncut_edges.nodes_along(edge);
  if (nodes.size() == 2) return;
  std::vector<InputHalfedgeId> along;
  subdivision_.operands.halfedges_along(edge.edge, along);
  for (const InputHalfedgeId h : along) {
    const FacetId facet = subdivision_.facets.of_face[Operands::face(h)];
    if (facet.is_none()) continue;
    const auto& [operand, plane, orientation, faces] = subdivision_.facets[facet];
    // The facet lies to the left of its half-edge, seen from its own front; the region's edges have it to their left,
    // seen from the front of the plane, whichever way the region looks.
    const bool runs_along = equal(subdivision_.operands.point(h), subdivision_.complex.nodes[nodes.front()]);
    add_along(nodes, plane, runs_along == (orientation > 0));
  }
}

void PseudoNodeFinder::add_along(std::span<const NodeId> nodes, PlaneId plane, bool is_forward) {
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const NodeId before = nodes[is_forward ? i - 1 : i + 1], after = nodes[is_forward ? i + 1 : i - 1];
    for (const bool is_flipped : {false, true}) found_.push_back({nodes[i], {plane, is_flipped}, before, after});
  }
}

std::vector<PseudoNode> PseudoNodeFinder::take() {
  std::ranges::sort(found_);
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  return std::move(found_);
}

/// The pseudo-nodes of the edge's region at one of its ends.
std::span<const PseudoNode> pseudo_nodes_at(NodeId node, const RegionEdge& edge, std::span<const PseudoNode> all) {
  return equal_span(all, std::tie(node, edge.region), &PseudoNode::place);
}

/// True if the edge is not the first of a straight run.
bool continues_another(const RegionEdge& edge, std::span<const PseudoNode> all) {
  return std::ranges::any_of(pseudo_nodes_at(edge.from, edge, all),
                             [&](const PseudoNode& p) { return p.after == edge.to; });
}

/// The node to which the straight edge goes on; none if it ends.
NodeId node_beyond(const RegionEdge& edge, std::span<const PseudoNode> all) {
  for (const PseudoNode& p : pseudo_nodes_at(edge.to, edge, all))
    if (p.before == edge.from) return p.after;
  return {};
}

}  // namespace

std::vector<PseudoNode> find_pseudo_nodes(const Subdivision& subdivision, const std::vector<RegionEdge>& edges,
                                          const PatchCorners& patch_corners) {
  PseudoNodeFinder finder(subdivision, patch_corners);
  finder.find_between(edges);
  for (const UncutEdge& edge : subdivision.uncut_edges.edges) finder.find_along(edge);
  return finder.take();
}

std::vector<RegionEdge> straightened(std::vector<RegionEdge> edges, std::span<const PseudoNode> pseudo_nodes) {
  std::size_t count = 0, plane_count = 0;
  for (const RegionEdge& edge : edges) {
    if (continues_another(edge, pseudo_nodes)) continue;
    RegionEdge last = edge;
    for (NodeId next = node_beyond(last, pseudo_nodes); !next.is_none(); next = node_beyond(last, pseudo_nodes))
      last.from = std::exchange(last.to, next);
    plane_count = std::max<std::size_t>(plane_count, edge.region.plane().index() + std::size_t{1});
    edges[count++] = {edge.region, edge.from, last.to};
  }
  edges.resize(count);
  bucket_sort(
      edges, plane_count, [](const RegionEdge& edge) { return edge.region.plane().index(); }, std::less());
  return edges;
}

}  // namespace algebra3d::arrangement
