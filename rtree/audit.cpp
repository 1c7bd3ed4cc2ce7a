#include <fmt/format.h>

#include "rtree/rtree.h"

namespace rtree {
namespace {

template <typename Payload>
class Auditor {
 public:
  explicit Auditor(const Storage<Payload>& storage) : storage_(storage), visits_(storage.nodes.size()) {}

  std::vector<std::string> run() {
    if (storage_.nodes.size() != storage_.infos.size()) {
      complain("{} nodes, but {} infos", storage_.nodes.size(), storage_.infos.size());
      return std::move(problems_);
    }
    walk();
    check_free_nodes();
    if (entries_found_ != storage_.entry_count)
      complain("{} entries in leaves, but the count says {}", entries_found_, storage_.entry_count);
    return std::move(problems_);
  }

 private:
  template <typename... Args>
  void complain(fmt::format_string<Args...> format, Args&&... args) {
    problems_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void walk() {
    if (storage_.root == kNoNode) return;
    if (storage_.root >= storage_.nodes.size()) return complain("root {} does not exist", storage_.root);
    if (storage_.infos[storage_.root].parent != kNoNode) complain("the root has a parent");
    std::vector<NodeIndex> stack{storage_.root};
    visits_[storage_.root] = 1;
    while (!stack.empty()) {
      const NodeIndex node = stack.back();
      stack.pop_back();
      if (!check_fill(node)) continue;
      if (storage_.infos[node].level == 0)
        entries_found_ += storage_.infos[node].count;
      else
        check_children(node, stack);
    }
  }

  bool check_fill(NodeIndex node) {
    const NodeInfo info = storage_.infos[node];
    if (info.count > kFanOut) {
      complain("node {} has {} slots in use, at most {} are possible", node, info.count, kFanOut);
      return false;
    }
    const std::size_t least = node != storage_.root ? kMinFill : info.level > 0 ? 2 : 1;
    if (info.count < least) complain("node {} has {} slots in use, at least {} are expected", node, info.count, least);
    for (std::size_t slot = 0; slot < kFanOut; ++slot) {
      const Box3 box = storage_.nodes[node].box(slot);
      if (slot < info.count && box.is_empty()) complain("node {} slot {} holds an empty box", node, slot);
      if (slot >= info.count && box.min.x == box.min.x) complain("node {} slot {} is unused but has a box", node, slot);
    }
    return true;
  }

  void check_children(NodeIndex node, std::vector<NodeIndex>& stack) {
    const NodeInfo info = storage_.infos[node];
    for (std::size_t slot = 0; slot < info.count; ++slot) {
      const NodeIndex child = storage_.nodes[node].child(slot);
      if (child >= storage_.nodes.size()) {
        complain("node {} slot {} names node {}, which does not exist", node, slot, child);
        continue;
      }
      if (++visits_[child] > 1) {
        complain("node {} is reached more than once", child);
        continue;
      }
      const NodeInfo child_info = storage_.infos[child];
      if (child_info.parent != node) complain("node {} names {} as its parent, not {}", child, child_info.parent, node);
      if (child_info.level + 1 != info.level)
        complain("node {} of level {} has child {} of level {}", node, info.level, child, child_info.level);
      else
        stack.push_back(child);
      if (child_info.count <= kFanOut && storage_.bounds(child) != storage_.nodes[node].box(slot))
        complain("node {} slot {}: the box is not the union of the boxes of child {}", node, slot, child);
    }
  }

  void check_free_nodes() {
    for (const NodeIndex node : storage_.free_nodes) {
      if (node >= storage_.nodes.size())
        complain("free node {} does not exist", node);
      else if (++visits_[node] > 1)
        complain("free node {} is in use or listed twice", node);
    }
    for (std::size_t node = 0; node < visits_.size(); ++node)
      if (visits_[node] == 0) complain("node {} is neither reachable nor free", node);
  }

  const Storage<Payload>& storage_;
  std::vector<std::uint32_t> visits_;
  std::vector<std::string> problems_;
  std::size_t entries_found_ = 0;
};

}  // namespace

template <typename Payload>
std::vector<std::string> audit(const Storage<Payload>& storage) {
  return Auditor<Payload>(storage).run();
}

template <typename Payload>
std::vector<std::string> audit(const RTree<Payload>& tree) {
  return audit(tree.storage());
}

template std::vector<std::string> audit(const Storage<std::uint32_t>&);
template std::vector<std::string> audit(const Storage<std::uint64_t>&);
template std::vector<std::string> audit(const RTree<std::uint32_t>&);
template std::vector<std::string> audit(const RTree<std::uint64_t>&);

}  // namespace rtree
