#include "algebra3d/kernel/arrangement/detail/sub_facets.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/numbers_by_bucket.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// A sub-edge as it leaves one of its ends.
struct OutgoingSubEdge {
  NodeId origin, target;
  std::uint32_t place;  ///< among the sub-edges of the plane

  /// The origin, then the sub-edge.
  std::uint64_t key() const { return std::uint64_t{origin.index()} << 32U | place; }
  /// The sides for someone who walks away from the origin, among those of the plane.
  std::uint32_t left() const { return 2 * place + (origin < target ? 0 : 1); }
  std::uint32_t right() const { return 2 * place + (origin < target ? 1 : 0); }
};

/// Angular order of the sub-edges that leave a node, from the direction just beyond -y (or -x) counter-clockwise.
class AngularOrder {
 public:
  AngularOrder(const NodePool& nodes, Projection projection, NodeId centre)
      : nodes_(nodes), projection_(projection), centre_(centre) {}

  /// Within half a turn the order is that of orientations; which half comes first is asked once for each sub-edge.
  void sort(std::span<OutgoingSubEdge> around) const {
    const auto second_half =
        std::partition(around.begin(), around.end(), [&](const OutgoingSubEdge& s) { return is_later(s.target); });
    const auto turns_left = [&](const OutgoingSubEdge& a, const OutgoingSubEdge& b) {
      return orient2d(projection_, nodes_[centre_], nodes_[a.target], nodes_[b.target]) > 0;
    };
    std::sort(around.begin(), second_half, turns_left);
    std::sort(second_half, around.end(), turns_left);
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

/// Finds the closed chains of sides in some planes, and numbers them from 0.
class ChainFinder {
 public:
  ChainFinder(const Subdivision& subdivision, IdVector<SubEdgeSide, FrontWindingId>& chains)
      : subdivision_(subdivision), chains_(chains) {}

  /// The sub-edges of one plane, ascending.
  Status add(std::span<const std::uint32_t> in_plane);
  std::size_t count() const { return count_; }

 private:
  void collect_sides(std::span<const std::uint32_t> in_plane);
  Status join_around(std::span<OutgoingSubEdge> around, Projection projection);
  void number_chains(std::span<const std::uint32_t> in_plane);

  const Subdivision& subdivision_;
  IdVector<SubEdgeSide, FrontWindingId>& chains_;
  std::size_t count_ = 0;
  // Working arrays for one plane, kept between planes for their memory.
  std::vector<OutgoingSubEdge> outgoing_;  // by origin
  std::vector<bool> is_covered_;           // per side
  std::vector<std::uint32_t> next_;        // the side that follows in the chain; kNone for sides that are not covered
};

void ChainFinder::collect_sides(std::span<const std::uint32_t> in_plane) {
  outgoing_.clear();
  is_covered_.assign(2 * in_plane.size(), false);
  for (std::uint32_t place = 0; place < in_plane.size(); ++place) {
    const auto [u, v] = subdivision_.sub_edges[SubEdgeId(in_plane[place])].ends;
    outgoing_.push_back({u, v, place});
    outgoing_.push_back({v, u, place});
    for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(SubEdgeId(in_plane[place])))
      for (const Side side : kSides)
        if (includes(incident.sides(), side)) is_covered_[2 * place + static_cast<std::uint32_t>(side)] = true;
  }
  std::ranges::sort(outgoing_, [](const OutgoingSubEdge& a, const OutgoingSubEdge& b) { return a.key() < b.key(); });
}

/// All sub-edges of a plane that leave a node.
Status ChainFinder::join_around(std::span<OutgoingSubEdge> around, Projection projection) {
  const NodePool& nodes = subdivision_.complex.nodes;
  if (around.size() > 2) AngularOrder(nodes, projection, around[0].origin).sort(around);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::uint32_t left = around[i].left(), right = around[i + 1 == around.size() ? 0 : i + 1].right();
    if (is_covered_[left] != is_covered_[right]) {
      const Vec3 at = nodes[around[0].origin].approx;
      return Error{ErrorCode::internal, "dividing a plane: a facet ends beside no edge at ({} {} {})", at.x, at.y,
                   at.z};
    }
    if (is_covered_[left]) next_[right] = left;
  }
  return {};
}

/// Each covered side is followed by one side and follows one.
void ChainFinder::number_chains(std::span<const std::uint32_t> in_plane) {
  for (std::uint32_t first = 0; first < next_.size(); ++first) {
    if (next_[first] == kNone) continue;
    const FrontWindingId chain(count_++);
    for (std::uint32_t side = first; next_[side] != kNone; side = std::exchange(next_[side], kNone))
      chains_[{SubEdgeId(in_plane[side / 2]), static_cast<Side>(side % 2)}] = chain;
  }
}

Status ChainFinder::add(std::span<const std::uint32_t> in_plane) {
  if (in_plane.empty()) return {};
  collect_sides(in_plane);
  next_.assign(2 * in_plane.size(), kNone);
  const Projection projection = subdivision_.plane_of(SubEdgeId(in_plane.front())).projection;
  for (std::size_t begin = 0, end = 0; begin < outgoing_.size(); begin = end) {
    while (end < outgoing_.size() && outgoing_[end].origin == outgoing_[begin].origin) ++end;
    A3D_TRY(join_around(std::span(outgoing_).subspan(begin, end - begin), projection));
  }
  number_chains(in_plane);
  return {};
}

/// Consecutive planes, and the number of their chains.
struct PlaneBlock {
  std::size_t first_plane, last_plane;
  std::size_t chain_count = 0;
  Status status = {};
};

std::vector<PlaneBlock> plane_blocks(std::size_t plane_count) {
  std::vector<PlaneBlock> blocks;
  for (std::size_t first = 0; first < plane_count; first += kPlanesPerTask)
    blocks.push_back({first, std::min(first + kPlanesPerTask, plane_count)});
  return blocks;
}

}  // namespace

Result<FrontWindingIds> number_front_windings(const Subdivision& subdivision) {
  const SubEdges& sub_edges = subdivision.sub_edges;
  const NumbersByBucket by_plane(sub_edges.size(), subdivision.facets.planes.size(),
                                 [&](std::size_t i) { return sub_edges[SubEdgeId(i)].plane.index(); });
  IdVector<SubEdgeSide, FrontWindingId> chains(sub_edges.sides().size());
  std::vector<PlaneBlock> blocks = plane_blocks(by_plane.bucket_count());
  parallel_for(blocks.size(), 1, [&](std::size_t i) {
    PlaneBlock& block = blocks[i];
    ChainFinder finder(subdivision, chains);
    for (std::size_t plane = block.first_plane; plane < block.last_plane && block.status.ok(); ++plane)
      block.status = finder.add(by_plane.of(plane));
    block.chain_count = finder.count();
  });
  std::vector<std::size_t> first_chains;
  std::size_t chain_count = 0;
  for (PlaneBlock& block : blocks) {
    A3D_TRY(std::move(block.status));
    first_chains.push_back(chain_count);
    chain_count += block.chain_count;
  }
  parallel_for(blocks.size(), 1, [&](std::size_t i) {
    for (const std::uint32_t s : by_plane.of(blocks[i].first_plane, blocks[i].last_plane))
      for (const Side side : kSides)
        if (FrontWindingId& chain = chains[{SubEdgeId(s), side}]; !chain.is_none())
          chain = FrontWindingId(first_chains[i] + chain.index());
  });
  return FrontWindingIds(std::move(chains), chain_count, subdivision.patches.patches.size());
}

}  // namespace algebra3d::arrangement
