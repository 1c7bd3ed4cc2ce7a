#include "rtree/rtree.h"

namespace rtree {

template <typename Payload>
RTree<Payload> RTree<Payload>::bulk_load(std::span<const Entry<Payload>> entries) {
  RTree tree;
  rtree::bulk_load(tree.storage_, entries.data(), entries.size());
  return tree;
}

template <typename Payload>
bool RTree<Payload>::insert(const Box3& box, Payload payload) {
  if (box.is_empty()) return false;
  rtree::insert(storage_, {box, payload});
  return true;
}

template <typename Payload>
bool RTree<Payload>::erase(const Box3& box, Payload payload) {
  return !box.is_empty() && rtree::erase(storage_, {box, payload});
}

template <typename Payload>
std::vector<Entry<Payload>> RTree<Payload>::entries() const {
  const TreeView<Payload> tree = view();
  std::vector<bool> is_free(tree.leaf_count);
  for (const NodeIndex leaf : storage_.free_leaves) is_free[leaf] = true;
  std::vector<Entry<Payload>> result;
  result.reserve(size());
  for (std::size_t i = 0; i < tree.leaf_count; ++i) {
    const auto leaf = static_cast<NodeIndex>(i);
    for (std::size_t slot = 0; !is_free[i] && slot < kFanOut && tree.leaves[i].is_used(slot); ++slot)
      result.push_back({tree.exact_box(leaf, slot).box(), tree.leaves[i].reference[slot]});
  }
  return result;
}

template class RTree<std::uint32_t>;
template class RTree<std::uint64_t>;

BoxTree::BoxTree(std::span<const Box3> boxes) : boxes_(boxes.data()) {
  bulk_load(storage_, boxes.data(), boxes.size());
}

}  // namespace rtree
