#include "algebra3d/arrangement/detail/linking.h"

#include <algorithm>
#include <span>
#include <utility>

#include "algebra3d/arrangement/detail/radial_order.h"
#include "algebra3d/arrangement/detail/slice.h"
#include "algebra3d/arrangement/detail/sub_facets.h"
#include "algebra3d/arrangement/detail/task_sizes.h"
#include "algebra3d/base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

class Linker {
 public:
  Linker(const Subdivision& subdivision, const WindingJumps& jumps) : subdivision_(subdivision), jumps_(jumps) {}

  Result<LinkedWindings> run();

 private:
  void link_at_uncut_edges();
  FrontWindingId link_patches_at(const UncutEdge& edge);
  void link_in_front_of_faces(SubEdgeId sub_edge, FrontWindingId patch);
  void order_round_edges();
  void order_round(IdRange<SubEdgeId> edge);
  void link_round(std::span<const SubEdgeSide> around);
  std::uint32_t count_operands(IdRange<SubEdgeId> edge);

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  LinkedWindings result_{{}, WindingSets(0), {}};
  // Half-planes with jumps in radial order, space edge by space edge, and those of each.
  std::vector<SubEdgeSide> half_planes_;
  std::vector<Slice> round_edges_;
  // Half-edges of the uncut edge, and half-planes of the space edge, at hand; members, so that their memory is used
  // again.
  std::vector<InputHalfedgeId> along_edge_;
  std::vector<SubEdgeSide> around_;
  std::vector<OperandId> operands_at_edge_;
};

/// No other operand is at an uncut edge, so the windings in front of all faces along each of its sub-edges are the
/// same. What is between the faces is not looked at, for not all of them are in sub-facets.
void Linker::link_at_uncut_edges() {
  for (const UncutEdge& edge : subdivision_.uncut_edges.edges) {
    const FrontWindingId patch = link_patches_at(edge);
    const auto nodes = subdivision_.sub_edges.segments.nodes(edge.segment);
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
  for (const auto& [facet, sides] : subdivision_.sub_edges.incident_to(sub_edge))
    for (const Side side : kSides) {
      if (!includes(sides, side)) continue;
      // In front of the face is in front of the plane, unless the face looks to the back of its plane.
      const SubEdgeSide at(sub_edge, side);
      const WindingVector excess = subdivision_.facets[facet].orientation > 0 ? WindingVector() : jumps_[at];
      result_.sets.unite(patch, result_.ids.of(at), -excess);
    }
}

std::uint32_t Linker::count_operands(IdRange<SubEdgeId> edge) {
  operands_at_edge_.clear();
  for (const SubEdgeId s : edge)
    for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(s))
      operands_at_edge_.push_back(subdivision_.facets[incident.facet].operand);
  std::ranges::sort(operands_at_edge_);
  return static_cast<std::uint32_t>(std::unique(operands_at_edge_.begin(), operands_at_edge_.end()) -
                                    operands_at_edge_.begin());
}

void Linker::order_round(IdRange<SubEdgeId> edge) {
  half_planes_with_jumps(jumps_, edge, around_);
  if (around_.empty()) return;
  sort_around_space_edge(subdivision_, around_);
  const std::size_t first = half_planes_.size();
  half_planes_.insert(half_planes_.end(), around_.begin(), around_.end());
  round_edges_.push_back(Slice::from(first, half_planes_));
  result_.seeds.push_back({edge, around_.front(), count_operands(edge)});
}

void Linker::order_round_edges() {
  subdivision_.sub_edges.for_each_space_edge([&](IdRange<SubEdgeId> edge) {
    const SpaceEdge ends = subdivision_.sub_edges[edge.front()].ends;
    if (!subdivision_.uncut_edges.space_edges.contains(ends)) order_round(edge);
  });
}

void Linker::link_round(std::span<const SubEdgeSide> around) {
  for (std::size_t i = 0; i < around.size(); ++i) {
    const SubEdgeSide h = around[i], next = around[i + 1 == around.size() ? 0 : i + 1];
    // Both give the windings of the cell between the two: their front winding and the excess.
    result_.sets.unite(result_.ids.of(h), result_.ids.of(next), excess_after(jumps_, h) - excess_before(jumps_, next));
  }
}

Result<LinkedWindings> Linker::run() {
  // The geometry of both kinds of links first, which is most of the work, and then the sets that they share.
  Result<FrontWindingIds> ids = FrontWindingIds();
  parallel_invoke(
      subdivision_.sub_edges.sub_edges.size() >= kSubEdgesWorthATask,
      [&] { ids = number_front_windings(subdivision_); }, [&] { order_round_edges(); });
  ALGEBRA3D_ASSIGN_OR_RETURN(result_.ids, std::move(ids));
  result_.sets = WindingSets(result_.ids.count());
  link_at_uncut_edges();
  for (const Slice& edge : round_edges_) link_round(edge.of(half_planes_));
  return std::move(result_);
}

}  // namespace

Result<LinkedWindings> link_windings(const Subdivision& subdivision, const WindingJumps& jumps) {
  return Linker(subdivision, jumps).run();
}

}  // namespace algebra3d::arrangement
