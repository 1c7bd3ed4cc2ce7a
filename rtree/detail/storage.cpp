#include "rtree/detail/storage.h"

#include <algorithm>
#include <cassert>

namespace rtree {

template <typename Payload>
NodeIndex Storage<Payload>::add_node(std::size_t level) {
  const NodeInfo info{kNoNode, 0, static_cast<std::uint16_t>(level)};
  if (!free_nodes.empty()) {
    const NodeIndex node = free_nodes.back();
    free_nodes.pop_back();
    infos[node] = info;
    return node;
  }
  assert(nodes.size() < kNoNode);
  nodes.emplace_back();
  infos.push_back(info);
  return static_cast<NodeIndex>(nodes.size() - 1);
}

template <typename Payload>
void Storage<Payload>::free_node(NodeIndex node) {
  clear(node);
  infos[node].parent = kNoNode;
  free_nodes.push_back(node);
}

template <typename Payload>
void Storage<Payload>::append(NodeIndex node, const Entry<Payload>& entry) {
  NodeInfo& info = infos[node];
  assert(info.count < kFanOut);
  nodes[node].set(info.count++, entry);
  if (info.level > 0) infos[static_cast<NodeIndex>(entry.payload)].parent = node;
}

template <typename Payload>
void Storage<Payload>::remove_slot(NodeIndex node, std::size_t slot) {
  const std::size_t last = --infos[node].count;
  assert(slot <= last);
  nodes[node].set(slot, nodes[node].entry(last));
  nodes[node].clear(last);
}

template <typename Payload>
void Storage<Payload>::clear(NodeIndex node) {
  nodes[node] = Node<Payload>();
  infos[node].count = 0;
}

template <typename Payload>
Box3 Storage<Payload>::bounds(NodeIndex node) const {
  const Node<Payload>& boxes = nodes[node];
  const std::size_t count = infos[node].count;
  Box3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t slot = 0; slot < count; ++slot) {
      result.min[axis] = std::min(result.min[axis], boxes.min[axis][slot]);
      result.max[axis] = std::max(result.max[axis], boxes.max[axis][slot]);
    }
  }
  return result;
}

template <typename Payload>
std::size_t Storage<Payload>::slot_in_parent(NodeIndex node) const {
  const NodeInfo& parent = infos[infos[node].parent];
  const Payload* references = nodes[infos[node].parent].reference;
  const Payload* found = std::find(references, references + parent.count, Payload{node});
  assert(found != references + parent.count);
  return static_cast<std::size_t>(found - references);
}

template struct Storage<std::uint32_t>;
template struct Storage<std::uint64_t>;

}  // namespace rtree
