#include "algebra3d/arrangement/detail/sub_facets.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// A sub-edge as it leaves one of its ends.
struct OutgoingSubEdge {
  PlaneId plane;
  NodeId origin, target;
  SubEdgeId sub_edge;

  /// The origin, then the sub-edge.
  std::uint64_t key_in_plane() const { return std::uint64_t{origin.index()} << 32U | sub_edge.index(); }
  /// The sides for someone who walks away from the origin.
  SubEdgeSide left() const { return {sub_edge, origin < target ? Side::left : Side::right}; }
  SubEdgeSide right() const { return {sub_edge, origin < target ? Side::right : Side::left}; }
};

/// Angular order of the sub-edges that leave a node, from the direction just beyond -y (or -x) counter-clockwise.
class AngularOrder {
 public:
  AngularOrder(const NodePool& nodes, Projection projection, NodeId centre)
      : nodes_(nodes), projection_(projection), centre_(centre) {}

  bool operator()(const OutgoingSubEdge& a, const OutgoingSubEdge& b) const {
    const bool a_later = is_later(a.target), b_later = is_later(b.target);
    if (a_later != b_later) return a_later;
    return orient2d(projection_, nodes_[centre_], nodes_[a.target], nodes_[b.target]) > 0;
  }

 private:
  /// True in the half-plane that comes first: directions of greater first, or equal first and greater second
  /// coordinate.
  bool is_later(NodeId node) const {
    auto order = compare(first_axis(projection_), nodes_[node], nodes_[centre_]);
    if (std::is_eq(order)) order = compare(second_axis(projection_), nodes_[node], nodes_[centre_]);
    return std::is_gt(order);
  }

  const NodePool& nodes_;
  Projection projection_;
  NodeId centre_;
};

/// The sub-edges plane by plane, ascending in each.
class SubEdgesOfPlanes {
 public:
  explicit SubEdgesOfPlanes(const Subdivision& subdivision)
      : begins_(subdivision.facets.planes.size() + 1), sub_edges_(subdivision.sub_edges.sub_edges.size()) {
    for (const SubEdgeId s : subdivision.sub_edges.ids())
      ++begins_[subdivision.sub_edges[s].plane.index() + std::size_t{1}];
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    for (const SubEdgeId s : subdivision.sub_edges.ids())
      sub_edges_[next[subdivision.sub_edges[s].plane.index()]++] = s;
  }

  std::span<const SubEdgeId> of(PlaneId plane) const {
    return std::span(sub_edges_)
        .subspan(begins_[plane.index()], begins_[plane.index() + std::size_t{1}] - begins_[plane.index()]);
  }

 private:
  std::vector<std::uint32_t> begins_;  // per plane, and where all end
  std::vector<SubEdgeId> sub_edges_;
};

/// The sub-edges of a plane as they leave their ends, by origin.
void collect_outgoing(std::span<const SubEdgeId> in_plane, const Subdivision& subdivision,
                      std::vector<OutgoingSubEdge>& outgoing) {
  outgoing.clear();
  for (const SubEdgeId s : in_plane) {
    const SubEdge& sub_edge = subdivision.sub_edges[s];
    const auto [u, v] = sub_edge.ends;
    outgoing.push_back({sub_edge.plane, u, v, s});
    outgoing.push_back({sub_edge.plane, v, u, s});
  }
  std::ranges::sort(outgoing, {}, &OutgoingSubEdge::key_in_plane);
}

/// All sub-edges of a plane that leave a node.
Status pair_around(std::span<OutgoingSubEdge> around, const Subdivision& subdivision,
                   std::vector<NeighbouringSides>& result) {
  const Projection projection = subdivision.facets.planes[around[0].plane].projection;
  const NodePool& nodes = subdivision.complex.nodes;
  if (around.size() > 2) std::ranges::sort(around, AngularOrder(nodes, projection, around[0].origin));
  for (std::size_t i = 0; i < around.size(); ++i) {
    const SubEdgeSide left = around[i].left(), right = around[i + 1 == around.size() ? 0 : i + 1].right();
    const bool is_covered = subdivision.sub_edges.is_covered(left);
    if (is_covered != subdivision.sub_edges.is_covered(right)) {
      const Vec3 at = nodes[around[0].origin].approx;
      return Error{ErrorCode::internal, "dividing a plane: a facet ends beside no edge at ({} {} {})", at.x, at.y,
                   at.z};
    }
    if (is_covered) result.push_back({left, right});
  }
  return {};
}

}  // namespace

// Plane by plane, so that little is kept at a time.
Result<std::vector<NeighbouringSides>> neighbouring_sides(const Subdivision& subdivision) {
  const SubEdgesOfPlanes by_plane(subdivision);
  std::vector<NeighbouringSides> result;
  result.reserve(2 * subdivision.sub_edges.sub_edges.size());
  std::vector<OutgoingSubEdge> outgoing;
  for (const PlaneId plane : subdivision.facets.planes.ids()) {
    collect_outgoing(by_plane.of(plane), subdivision, outgoing);
    for (std::size_t begin = 0, end = 0; begin < outgoing.size(); begin = end) {
      while (end < outgoing.size() && outgoing[end].origin == outgoing[begin].origin) ++end;
      ALGEBRA3D_RETURN_IF_ERROR(pair_around(std::span(outgoing).subspan(begin, end - begin), subdivision, result));
    }
  }
  return result;
}

}  // namespace algebra3d::arrangement
