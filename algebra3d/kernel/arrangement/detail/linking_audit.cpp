#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/radial_order.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {
namespace {

class LinkingAudit {
 public:
  LinkingAudit(const Subdivision& subdivision, const WindingJumps& jumps, const LinkedWindings& linked)
      : subdivision_(subdivision), jumps_(jumps), linked_(linked), sets_(linked.sets) {}

  std::vector<std::string> run();

 private:
  bool check_sizes();
  void check_space_edge(IdRange<SubEdgeId> line);
  void check_uncut_edge(const UncutEdge& edge);
  void check_seed(const SeedPlace& seed);
  /// Whether it is known that `b` is `a` plus `difference`.
  bool is_linked(FrontWindingId a, FrontWindingId b, const WindingVector& difference) {
    const WindingSets::Position at_a = sets_.find(a), at_b = sets_.find(b);
    return at_a.set == at_b.set && at_a.difference + difference == at_b.difference;
  }

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  const LinkedWindings& linked_;
  WindingSets sets_;  // a copy: what finds a set shortens the ways to it
  Violations violations_;
};

bool LinkingAudit::check_sizes() {
  const auto has_front = [&](SubEdgeSide side) {
    return jumps_[side] == WindingVector() || linked_.ids.of(side) < linked_.ids.of(PatchId(0));
  };
  return violations_.expect(sets_.ids().size() == linked_.ids.count(), "{} of {} front windings in the sets",
                            sets_.ids().size(), linked_.ids.count()) &&
         violations_.expect(std::ranges::all_of(subdivision_.sub_edges.sides(), has_front),
                            "a side with a jump has no front winding");
}

void LinkingAudit::check_space_edge(IdRange<SubEdgeId> line) {
  std::vector<SubEdgeSide> around;
  half_planes_with_jumps(jumps_, line, around);
  sort_around_space_edge(subdivision_, around);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const SubEdgeSide h = around[i], next = around[i + 1 == around.size() ? 0 : i + 1];
    violations_.expect(
        is_linked(linked_.ids.of(h), linked_.ids.of(next), excess_after(jumps_, h) - excess_before(jumps_, next)),
        "sub-edges {} and {} are not linked by the cell between them", h.sub_edge().index(), next.sub_edge().index());
  }
}

void LinkingAudit::check_uncut_edge(const UncutEdge& edge) {
  subdivision_.for_each_patch_at(edge, [&](PatchId first, PatchId patch) {
    violations_.expect(is_linked(linked_.ids.of(first), linked_.ids.of(patch), {}),
                       "patches {} and {} are not linked at their common edge", first.index(), patch.index());
  });
}

void LinkingAudit::check_seed(const SeedPlace& seed) {
  const SubEdges& sub_edges = subdivision_.sub_edges;
  const SubEdgeId first = seed.sub_edges.front(), own = seed.half_plane.sub_edge();
  const bool is_line = !seed.sub_edges.empty() && first.index() + seed.sub_edges.size() <= sub_edges.size() &&
                       sub_edges.along(sub_edges[first].ends).front() == first &&
                       sub_edges.along(sub_edges[first].ends).size() == seed.sub_edges.size();
  if (!violations_.expect(is_line, "a seed begins with sub-edge {} and has {}, which are not all along a space edge",
                          first.index(), seed.sub_edges.size()))
    return;
  violations_.expect(
      first <= own && own.index() < first.index() + seed.sub_edges.size() && jumps_[seed.half_plane] != WindingVector(),
      "the seed at sub-edge {} has no half-plane of its own with a jump", first.index());
  violations_.expect(seed.operand_count > 0, "the seed at sub-edge {} has no operand", first.index());
}

std::vector<std::string> LinkingAudit::run() {
  if (!check_sizes()) return violations_.take();
  subdivision_.sub_edges.for_each_space_edge([&](IdRange<SubEdgeId> line) {
    // At uncut edges not all faces are in sub-facets.
    if (!subdivision_.uncut_edges.space_edges.contains(subdivision_.sub_edges[line.front()].ends))
      check_space_edge(line);
  });
  for (const UncutEdge& edge : subdivision_.uncut_edges.edges) check_uncut_edge(edge);
  for (const SeedPlace& seed : linked_.seeds) check_seed(seed);
  return violations_.take();
}

}  // namespace

std::vector<std::string> audit(const Subdivision& subdivision, const WindingJumps& jumps,
                               const LinkedWindings& linked) {
  return LinkingAudit(subdivision, jumps, linked).run();
}

}  // namespace algebra3d::arrangement
