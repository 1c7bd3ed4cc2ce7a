#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/classification.h"
#include "algebra3d/kernel/arrangement/detail/radial_order.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {
namespace {

class ClassificationAudit {
 public:
  ClassificationAudit(const Subdivision& subdivision, const WindingJumps& jumps, Closure closure,
                      const Classification& classification)
      : subdivision_(subdivision), jumps_(jumps), closure_(closure), fronts_(classification) {
    for (const OperandId operand : subdivision.operands.ids()) ++counts_[subdivision.operands.group(operand)];
  }

  std::vector<std::string> run();

 private:
  void check_edge(IdRange<SubEdgeId> edge);
  bool is_possible(const WindingVector& windings) const;
  void check_range(SubEdgeSide side);
  void check_patch(PatchId patch);
  void check_uncut_edge(const UncutEdge& edge);

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  Closure closure_;
  const Classification& fronts_;
  WindingVector counts_;  // of the operands of each group
  Violations violations_;
};

/// Neighbours in the radial order give the windings of the cell between them.
void ClassificationAudit::check_edge(IdRange<SubEdgeId> edge) {
  std::vector<SubEdgeSide> around;
  half_planes_with_jumps(jumps_, edge, around);
  sort_around_space_edge(subdivision_, around);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const SubEdgeSide h = around[i], next = around[i + 1 == around.size() ? 0 : i + 1];
    violations_.expect(
        fronts_.at_sides[h] + excess_after(jumps_, h) == fronts_.at_sides[next] + excess_before(jumps_, next),
        "sub-edges {} and {} do not agree on the cell between them", h.sub_edge().index(), next.sub_edge().index());
  }
}

/// Each operand holds a cell once or not at all, if it is closed alone.
bool ClassificationAudit::is_possible(const WindingVector& windings) const {
  if (closure_ == Closure::together) return true;
  for (std::size_t group = 0; group < WindingVector::kGroupCount; ++group)
    if (windings[group] < 0 || windings[group] > counts_[group]) return false;
  return true;
}

void ClassificationAudit::check_range(SubEdgeSide side) {
  if (jumps_[side] == WindingVector()) return;
  const WindingVector front = fronts_.at_sides[side];
  violations_.expect(is_possible(front) && is_possible(front + jumps_[side]),
                     "sub-edge {}: windings ({} {}) in front, with the jump ({} {})", side.sub_edge().index(), front[0],
                     front[1], jumps_[side][0], jumps_[side][1]);
}

void ClassificationAudit::check_patch(PatchId patch) {
  const std::size_t group = subdivision_.operands.group(subdivision_.patches[patch].operand);
  const WindingVector front = fronts_.at_patches[patch];
  violations_.expect(is_possible(front) && is_possible(front + WindingVector::of_group(group, 1)),
                     "patch {}: windings ({} {}) in front", patch.index(), front[0], front[1]);
}

/// The windings in front of all faces at an uncut edge are the same.
void ClassificationAudit::check_uncut_edge(const UncutEdge& edge) {
  subdivision_.for_each_patch_at(edge, [&](PatchId first, PatchId patch) {
    violations_.expect(fronts_.at_patches[patch] == fronts_.at_patches[first],
                       "patches {} and {} do not agree at their common edge", first.index(), patch.index());
  });
}

std::vector<std::string> ClassificationAudit::run() {
  const bool has_all = fronts_.at_sides.size() == subdivision_.sub_edges.sides().size() &&
                       jumps_.size() == fronts_.at_sides.size() &&
                       fronts_.at_patches.size() == subdivision_.patches.patches.size();
  if (!violations_.expect(has_all, "front windings are missing")) return violations_.take();
  subdivision_.sub_edges.for_each_space_edge([&](IdRange<SubEdgeId> edge) {
    // At uncut edges not all faces are in sub-facets.
    const SpaceEdge ends = subdivision_.sub_edges[edge.front()].ends;
    if (!subdivision_.uncut_edges.space_edges.contains(ends)) check_edge(edge);
  });
  for (const SubEdgeSide side : subdivision_.sub_edges.sides()) check_range(side);
  for (const PatchId patch : subdivision_.patches.ids()) check_patch(patch);
  for (const UncutEdge& edge : subdivision_.uncut_edges.edges) check_uncut_edge(edge);
  return violations_.take();
}

}  // namespace

std::vector<std::string> audit(const Subdivision& subdivision, const WindingJumps& jumps, Closure closure,
                               const Classification& classification) {
  return ClassificationAudit(subdivision, jumps, closure, classification).run();
}

}  // namespace algebra3d::arrangement
