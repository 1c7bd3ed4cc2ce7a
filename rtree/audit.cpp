#include <fmt/format.h>

#include "rtree/rtree.h"

namespace rtree {
namespace {

template <typename Leaf>
class Auditor {
 public:
  explicit Auditor(const Storage<Leaf>& storage)
      : storage_(storage), leaf_visits_(storage.leaves.size()), inner_visits_(storage.inner.size()) {}

  std::vector<std::string> run() {
    storage_.unread.need_all();
    walk();
    check_free_nodes(storage_.free_leaf, storage_.leaves, leaf_visits_, "leaf");
    check_free_nodes(storage_.free_inner, storage_.inner, inner_visits_, "inner node");
    if (entries_found_ != storage_.entry_count)
      complain("{} entries in leaves, but the count says {}", entries_found_, storage_.entry_count);
    return std::move(problems_);
  }

 private:
  struct Step {
    NodeIndex node;
    std::uint32_t level;
  };

  template <typename... Args>
  void complain(fmt::format_string<Args...> format, Args&&... args) {
    problems_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  static const char* kind(std::uint32_t level) { return level == 0 ? "leaf" : "inner node"; }
  std::vector<std::uint32_t>& visits(std::uint32_t level) { return level == 0 ? leaf_visits_ : inner_visits_; }
  const KeyBoxes& boxes(const Step& step) const { return storage_.node(step.node, step.level); }

  void walk() {
    if (storage_.empty()) return;
    if (storage_.height >= kMaxLevels) return complain("a height of {} is not possible", storage_.height);
    if (storage_.root >= visits(storage_.height).size()) return complain("root {} does not exist", storage_.root);
    std::vector<Step> steps{{storage_.root, storage_.height}};
    visits(storage_.height)[storage_.root] = 1;
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      check_fill(step);
      if (step.level == 0)
        entries_found_ += boxes(step).count();
      else
        check_children(step, steps);
    }
  }

  void check_fill(const Step& step) {
    const KeyBoxes& node = boxes(step);
    const bool is_root = step.level == storage_.height;
    const std::size_t least = !is_root ? kMinFill : step.level > 0 ? 2 : 1;
    const std::size_t count = node.count();
    if (count < least)
      complain("{} {} has {} slots in use, at least {} are expected", kind(step.level), step.node, count, least);
    for (std::size_t slot = 0; slot < kFanOut; ++slot) {
      const KeyBox box = node.box(slot);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (slot < count && box.min[axis] > box.max[axis])
          complain("{} {} slot {} holds an empty box", kind(step.level), step.node, slot);
        if (slot >= count && (box.min[axis] != INT32_MAX || box.max[axis] != INT32_MIN))
          complain("{} {} slot {} is unused but has a box", kind(step.level), step.node, slot);
      }
    }
  }

  void check_children(const Step& step, std::vector<Step>& steps) {
    const InnerNode& node = storage_.inner_node(step.node, step.level);
    for (std::size_t slot = 0; slot < node.count(); ++slot) {
      const Step child{node.reference[slot], step.level - 1};
      if (child.node >= visits(child.level).size()) {
        complain("inner node {} slot {} names {} {}, which does not exist", step.node, slot, kind(child.level),
                 child.node);
        continue;
      }
      if (++visits(child.level)[child.node] > 1) {
        complain("{} {} is reached more than once", kind(child.level), child.node);
        continue;
      }
      steps.push_back(child);
      if (boxes(child).bounds() != node.box(slot))
        complain("inner node {} slot {}: the box is not the union of the boxes of {} {}", step.node, slot,
                 kind(child.level), child.node);
    }
  }

  template <typename Node>
  void check_free_nodes(NodeIndex first, const LargeVector<Node>& nodes, std::vector<std::uint32_t>& visits,
                        const char* kind) {
    for (std::uint64_t node = first; node != kNoNode; node = nodes[node].reference[0]) {
      if (node >= visits.size()) {
        complain("free {} {} does not exist", kind, node);
        break;
      }
      if (++visits[node] > 1) {
        complain("free {} {} is in use or listed twice", kind, node);
        break;
      }
      if (!nodes[node].is_clear()) complain("free {} {} is not clear", kind, node);
    }
    for (std::size_t node = 0; node < visits.size(); ++node)
      if (visits[node] == 0) complain("{} {} is neither reachable nor free", kind, node);
  }

  const Storage<Leaf>& storage_;
  std::vector<std::uint32_t> leaf_visits_, inner_visits_;
  std::vector<std::string> problems_;
  std::size_t entries_found_ = 0;
};

}  // namespace

template <typename Leaf>
std::vector<std::string> audit(const Storage<Leaf>& storage) {
  return Auditor<Leaf>(storage).run();
}

template <typename Payload>
std::vector<std::string> audit(const RTree<Payload>& tree) {
  return audit(tree.storage());
}

template std::vector<std::string> audit(const Storage<IndexLeaf>&);
template std::vector<std::string> audit(const Storage<ExactLeaf<std::uint32_t>>&);
template std::vector<std::string> audit(const Storage<ExactLeaf<std::uint64_t>>&);
template std::vector<std::string> audit(const RTree<std::uint32_t>&);
template std::vector<std::string> audit(const RTree<std::uint64_t>&);

}  // namespace rtree
