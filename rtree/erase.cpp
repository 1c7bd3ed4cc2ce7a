#include <algorithm>
#include <optional>
#include <vector>

#include "rtree/detail/box_size.h"
#include "rtree/detail/node_scan.h"
#include "rtree/detail/redistribution.h"
#include "rtree/detail/storage.h"

namespace rtree {
namespace {

struct Found {
  Path path;
  NodeIndex leaf;
  std::size_t slot;
};

// Looks for one entry along all ways to it, without recursion.
template <typename Payload>
class Finder {
 public:
  Finder(const Storage<ExactLeaf<Payload>>& storage, const Entry<Payload>& entry)
      : storage_(storage), payload_(entry.payload), box_(OrderedBox::of(entry.box)), keys_(storage.frame.keys(box_)) {}

  std::optional<Found> find() {
    if (storage_.empty() || !storage_.frame.has(box_)) return std::nullopt;
    steps_.push_back({{}, storage_.root, storage_.height});
    while (!steps_.empty()) {
      const Step step = steps_.back();
      steps_.pop_back();
      if (step.level > 0) {
        push_children(step);
        continue;
      }
      for (SlotMask slots = containing(storage_.leaf(step.node)); slots != 0;) {
        const std::size_t slot = take_slot(slots);
        const auto content = storage_.content(step.node, 0, slot);
        if (content.reference == payload_ && content.box == box_) return Found{step.path, step.node, slot};
      }
    }
    return std::nullopt;
  }

 private:
  struct Step {
    Path path;
    NodeIndex node;
    std::uint32_t level;
  };

  void push_children(const Step& step) {
    const InnerNode& node = storage_.inner_node(step.node, step.level);
    for (SlotMask slots = containing(node); slots != 0;) {
      const std::size_t slot = take_slot(slots);
      Step next{step.path, node.reference[slot], step.level - 1};
      next.path[next.level] = {step.node, slot};
      steps_.push_back(next);
    }
  }

  // The slots whose boxes contain that of the entry.
  SlotMask containing(const KeyBoxes& node) const {
    SlotMask result = 0;
    for (SlotMask slots = scans_.meeting(node, keys_); slots != 0;) {
      const std::size_t slot = take_slot(slots);
      if (node.box(slot).contains(keys_)) result |= SlotMask{1} << slot;
    }
    return result;
  }

  const NodeScans& scans_ = node_scans();
  const Storage<ExactLeaf<Payload>>& storage_;
  Payload payload_;
  OrderedBox box_;
  KeyBox keys_;
  std::vector<Step> steps_;
};

template <typename Payload>
void tighten_slot(Storage<ExactLeaf<Payload>>& storage, const PathStep& parent, std::uint32_t child_level) {
  const NodeIndex child = storage.inner[parent.node].reference[parent.slot];
  storage.set_child_box(parent, storage.node(child, child_level).bounds());
}

// The slot of the sister that grows least by taking the node in; of equal ones the lowest.
template <typename Payload>
std::size_t choose_sister(const Storage<ExactLeaf<Payload>>& storage, const PathStep& parent) {
  const InnerNode& node = storage.inner[parent.node];
  const auto box_at = [&](std::size_t slot) { return storage.frame.outer_box(node.box(slot)).box(); };
  const Box3 own = box_at(parent.slot);
  std::size_t best = kFanOut;
  double least_growth = 0;
  for (std::size_t slot = 0; slot < node.count(); ++slot) {
    if (slot == parent.slot) continue;
    const Box3 box = box_at(slot);
    const double growth = margin(unite(box, own)) - margin(box);
    if (best < kFanOut && !(growth < least_growth)) continue;
    best = slot;
    least_growth = growth;
  }
  return best;
}

// Merges an underfull node with a sister ([guttman1984], section 3.3, names it as the alternative to reinsertion), or
// shares the entries out anew where one node cannot hold them. Local and bounded, whatever the tree looks like.
template <typename Payload>
void fill_up(Storage<ExactLeaf<Payload>>& storage, const PathStep& parent, std::uint32_t level) {
  // The sister is chosen by the box that the node has now.
  tighten_slot(storage, parent, level);
  const PathStep sister_step{parent.node, choose_sister(storage, parent)};
  const NodeIndex node = storage.inner[parent.node].reference[parent.slot];
  const NodeIndex sister = storage.inner[parent.node].reference[sister_step.slot];
  Redistribution<Payload> redistribution;
  redistribution.take(storage, sister, level);
  redistribution.take(storage, node, level);
  const std::size_t left = redistribution.distribute(storage, sister, node, level);
  tighten_slot(storage, sister_step, level);
  if (left > 0) return tighten_slot(storage, parent, level);
  storage.remove_slot(parent.node, level + 1, parent.slot);
  storage.free_node(node, level);
}

// Shortens the tree while the root has a single child.
template <typename Payload>
void shrink_root(Storage<ExactLeaf<Payload>>& storage) {
  while (storage.height > 0 && storage.inner_node(storage.root, storage.height).count() == 1) {
    const NodeIndex old_root = storage.root;
    storage.root = storage.inner[old_root].reference[0];
    storage.free_node(old_root, storage.height--);
  }
}

}  // namespace

template <typename Payload>
bool erase(Storage<ExactLeaf<Payload>>& storage, const Entry<Payload>& entry) {
  const auto found = Finder<Payload>(storage, entry).find();
  if (!found) return false;
  if (--storage.entry_count == 0) {
    storage = {};
    return true;
  }
  storage.remove_slot(found->leaf, 0, found->slot);
  NodeIndex node = found->leaf;
  for (std::uint32_t level = 0; level < storage.height; ++level) {
    const PathStep& parent = found->path[level];
    if (storage.node(node, level).count() < kMinFill)
      fill_up(storage, parent, level);
    else
      tighten_slot(storage, parent, level);
    node = parent.node;
  }
  shrink_root(storage);
  return true;
}

template bool erase(Storage<ExactLeaf<std::uint32_t>>&, const Entry<std::uint32_t>&);
template bool erase(Storage<ExactLeaf<std::uint64_t>>&, const Entry<std::uint64_t>&);

}  // namespace rtree
