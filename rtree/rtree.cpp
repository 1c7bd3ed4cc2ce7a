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
Box3 RTree<Payload>::bounds() const {
  return storage_.root == kNoNode ? Box3{} : storage_.bounds(storage_.root);
}

template <typename Payload>
std::size_t RTree<Payload>::heap_bytes() const {
  return storage_.nodes.capacity() * sizeof(Node<Payload>) + storage_.infos.capacity() * sizeof(NodeInfo) +
         storage_.free_nodes.capacity() * sizeof(NodeIndex);
}

template class RTree<std::uint32_t>;
template class RTree<std::uint64_t>;

}  // namespace rtree
