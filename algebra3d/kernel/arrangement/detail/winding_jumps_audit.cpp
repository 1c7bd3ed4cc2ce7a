#include <algorithm>
#include <cstdlib>

#include "algebra3d/kernel/arrangement/detail/radial_order.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/arrangement/detail/winding_jumps.h"

namespace algebra3d::arrangement {
namespace {

class WindingJumpsAudit {
 public:
  WindingJumpsAudit(const Subdivision& subdivision, const WindingJumps& jumps)
      : subdivision_(subdivision), sub_edges_(subdivision.sub_edges), jumps_(jumps) {}

  std::vector<std::string> run();

 private:
  void check_side(SubEdgeSide side);
  void check_space_edge(IdRange<SubEdgeId> line);

  const Subdivision& subdivision_;
  const SubEdges& sub_edges_;
  const WindingJumps& jumps_;
  Violations violations_;
};

/// Each facet adds 1 or -1.
void WindingJumpsAudit::check_side(SubEdgeSide side) {
  WindingVector most;
  for (const IncidentFacet& incident : sub_edges_.incident_to(side.sub_edge()))
    if (includes(incident.sides(), side.side()))
      ++most[subdivision_.operands.group(subdivision_.facets[incident.facet()].operand)];
  for (std::size_t group = 0; group < WindingVector::kGroupCount; ++group)
    violations_.expect(std::abs(jumps_[side][group]) <= most[group] && (jumps_[side][group] - most[group]) % 2 == 0,
                       "side {} of sub-edge {}: a jump of {} at {} facets of group {}",
                       side.side() == Side::left ? "left" : "right", side.sub_edge().index(), jumps_[side][group],
                       most[group], group);
}

/// Someone who goes once round the line enters as many operands as he leaves.
void WindingJumpsAudit::check_space_edge(IdRange<SubEdgeId> line) {
  std::vector<SubEdgeSide> around;
  half_planes_with_jumps(jumps_, line, around);
  WindingVector gained;
  for (const SubEdgeSide h : around) gained = gained + excess_after(jumps_, h) - excess_before(jumps_, h);
  violations_.expect(gained == WindingVector(), "round sub-edge {} windings change by ({} {}) in all",
                     line.front().index(), gained[0], gained[1]);
}

std::vector<std::string> WindingJumpsAudit::run() {
  if (!violations_.expect(jumps_.size() == sub_edges_.sides().size(), "{} winding jumps for {} sides", jumps_.size(),
                          sub_edges_.sides().size()))
    return violations_.take();
  for (const SubEdgeSide side : sub_edges_.sides()) check_side(side);
  sub_edges_.for_each_space_edge([&](IdRange<SubEdgeId> line) {
    // At uncut edges not all faces are in sub-facets.
    if (!subdivision_.uncut_edges.space_edges.contains(sub_edges_[line.front()].ends)) check_space_edge(line);
  });
  return violations_.take();
}

}  // namespace

std::vector<std::string> audit(const Subdivision& subdivision, const WindingJumps& jumps) {
  return WindingJumpsAudit(subdivision, jumps).run();
}

}  // namespace algebra3d::arrangement
