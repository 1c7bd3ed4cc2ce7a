#include "algebra3d/arrangement/detail/linking.h"

#include <algorithm>
#include <span>
#include <utility>

#include "algebra3d/arrangement/detail/radial_order.h"
#include "algebra3d/arrangement/detail/sub_facets.h"
#include "algebra3d/arrangement/detail/task_sizes.h"
#include "algebra3d/base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Half-planes with jumps in radial order, space edge by space edge.
struct RadialOrders {
  std::vector<SubEdgeSide> half_planes;
  std::vector<std::uint32_t> counts;  // of those round each space edge
};

class Linker {
 public:
  Linker(const Subdivision& subdivision, const WindingJumps& jumps) : subdivision_(subdivision), jumps_(jumps) {}

  Result<LinkedWindings> run();

 private:
  void link_at_uncut_edges();
  FrontWindingId link_patches_at(const UncutEdge& edge);
  void link_in_front_of_faces(SubEdgeId sub_edge, FrontWindingId patch);
  void link_round_space_edges();
  RadialOrders radial_orders(IdRange<SubEdgeId> first_sub_edges) const;
  void link_round(std::span<const SubEdgeSide> around);
  void find_seeds();
  std::uint32_t count_operands(IdRange<SubEdgeId> edge);
  bool is_on_uncut_edge(IdRange<SubEdgeId> edge) const {
    return subdivision_.uncut_edges.space_edges.contains(subdivision_.sub_edges[edge.front()].ends);
  }

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  LinkedWindings result_{{}, WindingSets(0), {}};
  // Half-edges of the uncut edge, and operands at the space edge, at hand; members, so that their memory is used again.
  std::vector<InputHalfedgeId> along_edge_;
  std::vector<OperandId> operands_at_edge_;
};

/// No other operand is at an uncut edge, so the windings in front of all faces along each of its sub-edges are the
/// same. What is between the faces is not looked at, for not all of them are in sub-facets.
void Linker::link_at_uncut_edges() {
  for (const UncutEdge& edge : subdivision_.uncut_edges.edges) {
    const FrontWindingId patch = link_patches_at(edge);
    const auto nodes = subdivision_.uncut_edges.nodes_along(edge);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      for (const SubEdgeId s : subdivision_.sub_edges.along(SpaceEdge::of(nodes[i], nodes[i + 1])))
        link_in_front_of_faces(s, patch);
  }
}

/// Gives the front winding of one of them.
FrontWindingId Linker::link_patches_at(const UncutEdge& edge) {
  FrontWindingId first;
  subdivision_.operands.halfedges_along(edge.edge, along_edge_);
  for (const InputHalfedgeId h : along_edge_) {
    const PatchId patch = subdivision_.patches.of_face[Operands::face(h)];
    if (patch.is_none()) continue;
    const FrontWindingId front = result_.ids.of(patch);
    if (first.is_none()) first = front;
    result_.sets.unite(first, front, {});
  }
  return first;
}

void Linker::link_in_front_of_faces(SubEdgeId sub_edge, FrontWindingId patch) {
  for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(sub_edge))
    for (const Side side : kSides) {
      if (!includes(incident.sides(), side)) continue;
      // In front of the face is in front of the plane, unless the face looks to the back of its plane.
      const SubEdgeSide at(sub_edge, side);
      const WindingVector excess = subdivision_.facets[incident.facet()].orientation > 0 ? WindingVector() : jumps_[at];
      result_.sets.unite(patch, result_.ids.of(at), -excess);
    }
}

std::uint32_t Linker::count_operands(IdRange<SubEdgeId> edge) {
  operands_at_edge_.clear();
  for (const SubEdgeId s : edge)
    for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(s))
      operands_at_edge_.push_back(subdivision_.facets[incident.facet()].operand);
  std::ranges::sort(operands_at_edge_);
  return static_cast<std::uint32_t>(std::unique(operands_at_edge_.begin(), operands_at_edge_.end()) -
                                    operands_at_edge_.begin());
}

/// The radial orders round the space edges that begin with a sub-edge of the range.
RadialOrders Linker::radial_orders(IdRange<SubEdgeId> first_sub_edges) const {
  RadialOrders orders;
  std::vector<SubEdgeSide> around;
  subdivision_.sub_edges.for_each_space_edge(first_sub_edges, [&](IdRange<SubEdgeId> edge) {
    if (is_on_uncut_edge(edge)) return;
    half_planes_with_jumps(jumps_, edge, around);
    if (around.empty()) return;
    sort_around_space_edge(subdivision_, around);
    orders.half_planes.insert(orders.half_planes.end(), around.begin(), around.end());
    orders.counts.push_back(static_cast<std::uint32_t>(around.size()));
  });
  return orders;
}

/// Block by block: the geometry in parallel, which is most of the work, and then the sets.
void Linker::link_round_space_edges() {
  const std::size_t count = subdivision_.sub_edges.size();
  for (std::size_t first = 0; first < count; first += kSubEdgesPerBlock) {
    const auto found = parallel_collect(
        std::min(kSubEdgesPerBlock, count - first), kSubEdgesPerTask, [&](std::size_t begin, std::size_t end) {
          std::vector<RadialOrders> orders;
          orders.push_back(radial_orders({SubEdgeId(first + begin), SubEdgeId(first + end)}));
          return orders;
        });
    for (const RadialOrders& orders : found) {
      auto around = orders.half_planes.begin();
      for (const std::uint32_t size : orders.counts) {
        link_round({around, around + size});
        around += size;
      }
    }
  }
}

void Linker::link_round(std::span<const SubEdgeSide> around) {
  for (std::size_t i = 0; i < around.size(); ++i) {
    const SubEdgeSide h = around[i], next = around[i + 1 == around.size() ? 0 : i + 1];
    // Both give the windings of the cell between the two: their front winding and the excess.
    result_.sets.unite(result_.ids.of(h), result_.ids.of(next), excess_after(jumps_, h) - excess_before(jumps_, next));
  }
}

void Linker::find_seeds() {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<SeedPlace>& seeds = result_.seeds;
  IdVector<FrontWindingId, std::uint32_t> seed_of_set(result_.ids.count(), kNone);
  subdivision_.sub_edges.for_each_space_edge([&](IdRange<SubEdgeId> edge) {
    const SubEdgeSide half_plane = first_with_jump(jumps_, edge);
    if (half_plane.is_none() || is_on_uncut_edge(edge)) return;
    std::uint32_t& known = seed_of_set[result_.sets.find(result_.ids.of(half_plane)).set];
    if (known != kNone && seeds[known].operand_count == subdivision_.operands.count()) return;
    const SeedPlace place{edge, half_plane, count_operands(edge)};
    if (known == kNone) {
      known = static_cast<std::uint32_t>(seeds.size());
      seeds.push_back(place);
    } else if (place.operand_count > seeds[known].operand_count) {
      seeds[known] = place;
    }
  });
}

Result<LinkedWindings> Linker::run() {
  ALGEBRA3D_ASSIGN_OR_RETURN(result_.ids, number_front_windings(subdivision_));
  result_.sets = WindingSets(result_.ids.count());
  link_at_uncut_edges();
  link_round_space_edges();
  find_seeds();
  return std::move(result_);
}

}  // namespace

Result<LinkedWindings> link_windings(const Subdivision& subdivision, const WindingJumps& jumps) {
  return Linker(subdivision, jumps).run();
}

}  // namespace algebra3d::arrangement
