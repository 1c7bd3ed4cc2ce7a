#include "rtree/nodes.h"

namespace rtree {
namespace {

/// Lists the nodes below a node. The depth of the recursion is the height of the tree, at most kMaxLevels.
template <typename Leaf>
class NodeLister {
 public:
  explicit NodeLister(const TreeView<Leaf>& tree) : tree_(tree) {}

  std::vector<NodeSummary> list() {
    if (!tree_.empty()) add(tree_.root, tree_.height);
    return std::move(nodes_);
  }

 private:
  /// Returns the box of the node, which is known after those of its children.
  Box3 add(NodeIndex node, std::uint32_t level) {
    const std::size_t place = nodes_.size(), count = tree_.node(node, level).count();
    nodes_.push_back({tree_.height - level, level == 0, count, {}});
    Box3 box;
    for (std::size_t slot = 0; slot < count; ++slot)
      box.extend(level == 0 ? tree_.exact_coordinates(node, slot)
                            : add(tree_.inner_node(node, level).reference[slot], level - 1));
    nodes_[place].box = box;
    return box;
  }

  const TreeView<Leaf> tree_;
  std::vector<NodeSummary> nodes_;
};

}  // namespace

template <typename Payload>
std::vector<NodeSummary> nodes_of(const RTree<Payload>& tree) {
  return NodeLister(tree.storage().view()).list();
}

template std::vector<NodeSummary> nodes_of(const RTree<std::uint32_t>&);
template std::vector<NodeSummary> nodes_of(const RTree<std::uint64_t>&);

}  // namespace rtree
