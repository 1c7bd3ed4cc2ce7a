#include "rtree/rtree.h"

namespace rtree {
namespace {

// Used slots of a node that leaves room for changes.
constexpr std::size_t kRoomyFill = 14;

}  // namespace

template <typename Payload>
RTree<Payload> RTree<Payload>::bulk_load(std::span<const Entry<Payload>> entries, Filling filling) {
  RTree tree;
  rtree::bulk_load(tree.storage_, entries, filling == Filling::full ? kFanOut : kRoomyFill);
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
  std::vector<Entry<Payload>> result;
  storage_.unread.need_all();
  result.reserve(size());
  // Free leaves have no slots in use.
  for (const ExactLeaf<Payload>& leaf : storage_.leaves)
    for (std::size_t slot = 0; slot < kFanOut && leaf.is_used(slot); ++slot)
      result.push_back({exact_box(storage_.frame, leaf, leaf.remainders, slot).box(), leaf.reference[slot]});
  return result;
}

template class RTree<std::uint32_t>;
template class RTree<std::uint64_t>;

BoxTree::BoxTree(std::span<const Box3> boxes) : boxes_(boxes.data()) {
  bulk_load(storage_, boxes);
}

}  // namespace rtree
