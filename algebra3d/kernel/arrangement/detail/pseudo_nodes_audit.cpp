#include "algebra3d/kernel/arrangement/detail/pseudo_nodes.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

bool has_nodes(const NodePool& nodes, const PseudoNode& at) {
  return at.node.index() < nodes.size() && at.before.index() < nodes.size() && at.after.index() < nodes.size();
}

bool is_between(const NodePool& nodes, const PseudoNode& at) {
  const auto before = nodes[at.before], node = nodes[at.node], after = nodes[at.after];
  return at.before != at.node && compare(before, node) == compare(node, after) && collinear(before, node, after);
}

}  // namespace

std::vector<std::string> audit(const Subdivision& subdivision, const std::vector<PseudoNode>& pseudo_nodes) {
  Violations violations;
  const NodePool& nodes = subdivision.complex.nodes;
  for (const PseudoNode& at : pseudo_nodes)
    if (violations.expect(has_nodes(nodes, at), "pseudo-node {} or a neighbour of it is not a node", at.node.index()))
      violations.expect(is_between(nodes, at), "pseudo-node {} does not lie between nodes {} and {}", at.node.index(),
                        at.before.index(), at.after.index());
  for (std::size_t i = 1; i < pseudo_nodes.size(); ++i) {
    const PseudoNode &last = pseudo_nodes[i - 1], &next = pseudo_nodes[i];
    violations.expect(last < next, "pseudo-node {} is not behind the one before it", next.node.index());
    violations.expect(last.place() != next.place() || last.before != next.before || last == next,
                      "the straight edge from node {} goes on from pseudo-node {} to node {} and to node {}",
                      next.before.index(), next.node.index(), last.after.index(), next.after.index());
  }
  return violations.take();
}

}  // namespace algebra3d::arrangement
