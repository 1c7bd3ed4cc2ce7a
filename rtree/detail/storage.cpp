#include "rtree/detail/storage.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace rtree {

namespace {

/// Keys of four slots, as a vector of the compiler (GCC and Clang, any processor).
using FourKeys = std::int32_t __attribute__((vector_size(16)));
constexpr std::size_t kFour = 4;

FourKeys load(const std::int32_t* keys) {
  FourKeys result;
  std::memcpy(&result, keys, sizeof(result));
  return result;
}

}  // namespace

// In vectors, since each node of a stored tree is looked at when it is read.
bool KeyBoxes::is_sound(std::size_t fewest) const {
  FourKeys wrong{}, unused{};
  for (std::size_t slot = 0; slot < kFanOut; slot += kFour) {
    const FourKeys is_unused = load(&min[0][slot]) == INT32_MAX;
    unused -= is_unused;  // a comparison gives -1
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const FourKeys low = load(&min[axis][slot]), high = load(&max[axis][slot]);
      const FourKeys is_no_box = (low > high) | (high == INT32_MAX);
      const FourKeys is_not_clear = (low != INT32_MAX) | (high != INT32_MIN);
      wrong |= (is_no_box & is_not_clear) | ((low == INT32_MAX) ^ is_unused);
    }
  }
  const auto used = kFanOut - static_cast<std::size_t>(unused[0] + unused[1] + unused[2] + unused[3]);
  // Used slots come first if none comes after the first unused one.
  return (wrong[0] | wrong[1] | wrong[2] | wrong[3]) == 0 && used >= fewest && used == count();
}

template <typename Leaf>
Box3 TreeView<Leaf>::bounds() const {
  if (empty()) return {};
  const KeyBox keys = node(root, height).bounds();
  OrderedBox result{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
  struct Step {
    NodeIndex node;
    std::uint32_t level;
  };
  std::vector<Step> steps{{root, height}};
  while (!steps.empty()) {
    const auto [index, level] = steps.back();
    steps.pop_back();
    const KeyBoxes& slots = node(index, level);
    for (std::size_t slot = 0; slot < kFanOut && slots.is_used(slot); ++slot) {
      const KeyBox box = slots.box(slot);
      bool is_extreme = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        is_extreme |= (box.min[axis] == keys.min[axis]) | (box.max[axis] == keys.max[axis]);
      if (!is_extreme) continue;
      if (level == 0)
        result.extend(exact_box(index, slot));
      else
        steps.push_back({inner_node(index, level).reference[slot], level - 1});
    }
  }
  return result.box();
}

template <typename Leaf>
NodeIndex Storage<Leaf>::add_node(std::uint32_t level) {
  auto node = static_cast<NodeIndex>(level == 0 ? leaves.size() : inner.size());
  if ((level == 0 ? free_leaf : free_inner) != kNoNode)
    node = take_free(level);
  else
    add_to_arrays(level);
  clear(node, level);
  return node;
}

template <typename Leaf>
void Storage<Leaf>::add_to_arrays(std::uint32_t level) {
  if (level == 0)
    leaves.resize(leaves.size() + 1);
  else
    inner.emplace_back();
  if (auto* const nodes = unread.get()) nodes->move_to(inner.data(), leaves.data());
}

template <typename Leaf>
NodeIndex Storage<Leaf>::take_free(std::uint32_t level) {
  NodeIndex& first = level == 0 ? free_leaf : free_inner;
  const NodeIndex node = first;
  if (node >= (level == 0 ? leaves.size() : inner.size()))
    throw DamagedImage(fmt::format("image of an R-tree: node {} is listed as free", node));
  if (auto* const nodes = unread.get()) nodes->take_free(node, level);
  first = level == 0 ? static_cast<NodeIndex>(leaves[node].reference[0]) : inner[node].reference[0];
  return node;
}

template <typename Leaf>
void Storage<Leaf>::free_node(NodeIndex node, std::uint32_t level) {
  clear(node, level);
  if (auto* const nodes = unread.get()) nodes->set_free(node, level);
  NodeIndex& first = level == 0 ? free_leaf : free_inner;
  if (level == 0)
    leaves[node].reference[0] = first;
  else
    inner[node].reference[0] = first;
  first = node;
}

template <typename Leaf>
void Storage<Leaf>::clear(NodeIndex node, std::uint32_t level) {
  mark(node, level);
  if (level > 0) {
    inner_node(node, level).clear();
    std::ranges::fill(inner[node].reference, 0);
    return;
  }
  Leaf& leaf = this->leaf(node);
  leaf.clear();
  std::ranges::fill(leaf.reference, 0);
  leaf.remainders.clear();
}

template <typename Leaf>
auto Storage<Leaf>::content(NodeIndex node, std::uint32_t level, std::size_t slot) const -> SlotContent<Payload> {
  if (level > 0) {
    const InnerNode& found = inner_node(node, level);
    return {frame.outer_box(found.box(slot)), Payload{found.reference[slot]}};
  }
  const Leaf& leaf = this->leaf(node);
  return {exact_box(frame, leaf, leaf.remainders, slot), leaf.reference[slot]};
}

template <typename Leaf>
void Storage<Leaf>::set(NodeIndex node, std::uint32_t level, std::size_t slot, const SlotContent<Payload>& content) {
  mark(node, level);
  const KeyBox keys = frame.keys_in_range(content.box);
  if (level > 0) {
    InnerNode& found = inner_node(node, level);
    found.set_box(slot, keys);
    found.reference[slot] = static_cast<NodeIndex>(content.reference);
    return;
  }
  Leaf& leaf = this->leaf(node);
  leaf.set_box(slot, keys);
  leaf.reference[slot] = content.reference;
  leaf.remainders.set(slot, content.box, frame);
}

template <typename Leaf>
void Storage<Leaf>::set_child_box(const PathStep& place, const KeyBox& box) {
  if (inner[place.node].box(place.slot) == box) return;
  changed_inner.insert(place.node);
  inner[place.node].set_box(place.slot, box);
}

template <typename Leaf>
void Storage<Leaf>::remove_slot(NodeIndex node, std::uint32_t level, std::size_t slot) {
  const std::size_t last = this->node(node, level).count() - 1;
  set(node, level, slot, content(node, level, last));
  if (level > 0) {
    inner[node].KeyBoxes::clear(last);
    inner[node].reference[last] = 0;
    return;
  }
  Leaf& leaf = this->leaf(node);
  leaf.KeyBoxes::clear(last);
  leaf.reference[last] = 0;
  leaf.remainders.set(last, {}, frame);
}

template <typename Leaf>
void Storage<Leaf>::widen_frame(const OrderedBox& box) {
  unread.need_all();
  const KeyFrame old = frame;
  frame = old.widened(box);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    Leaf& leaf = leaves[i];
    changed_leaves.insert(static_cast<NodeIndex>(i));
    for (std::size_t slot = 0; slot < kFanOut && leaf.is_used(slot); ++slot) {
      const OrderedBox exact = exact_box(old, leaf, leaf.remainders, slot);
      leaf.set_box(slot, frame.keys_in_range(exact));
      leaf.remainders.set(slot, exact, frame);
    }
  }
  // Rounding to wider keys keeps unions.
  for (std::size_t i = 0; i < inner.size(); ++i) {
    changed_inner.insert(static_cast<NodeIndex>(i));
    for (std::size_t slot = 0; slot < kFanOut && inner[i].is_used(slot); ++slot)
      inner[i].set_box(slot, frame.keys_in_range(old.outer_box(inner[i].box(slot))));
  }
}

template struct TreeView<IndexLeaf>;
template struct TreeView<ExactLeaf<std::uint32_t>>;
template struct TreeView<ExactLeaf<std::uint64_t>>;
template struct Storage<ExactLeaf<std::uint32_t>>;
template struct Storage<ExactLeaf<std::uint64_t>>;

}  // namespace rtree
