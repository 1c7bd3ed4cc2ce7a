#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rtree/rtree.h"

namespace rtree {

/// A node as a tree is looked at from outside.
struct NodeSummary {
  std::uint32_t depth;       ///< 0 for the root
  bool is_leaf;              ///< of leaves all have the same depth
  std::size_t member_count;  ///< children, or entries of a leaf
  Box3 box;                  ///< smallest around all entries below
};

/// All nodes of a tree, a parent before its children, these in the order of its slots; none of an empty tree. Reads the
/// leaves that were not read. Cost: linear.
template <typename Payload>
std::vector<NodeSummary> nodes_of(const RTree<Payload>& tree);

}  // namespace rtree
