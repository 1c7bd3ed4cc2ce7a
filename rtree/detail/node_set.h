#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rtree/detail/node.h"

namespace rtree {

/// Consecutive nodes.
struct NodeRange {
  std::size_t begin, end;

  friend bool operator==(const NodeRange&, const NodeRange&) = default;
};

/// A set of nodes of one kind, with one bit for each.
class NodeSet {
 public:
  NodeSet() = default;
  /// Empty, with room for the nodes below `count`.
  explicit NodeSet(std::size_t count) : words_((count + kBits - 1) / kBits) {}

  /// Adds a node; true if it was not there.
  bool insert(NodeIndex node) {
    const std::size_t word = node / kBits;
    if (word >= words_.size()) words_.resize(word + 1);
    const std::uint64_t bit = std::uint64_t{1} << (node % kBits);
    const bool is_new = (words_[word] & bit) == 0;
    words_[word] |= bit;
    return is_new;
  }
  bool has(NodeIndex node) const {
    return node / kBits < words_.size() && (words_[node / kBits] >> (node % kBits) & 1) != 0;
  }
  void clear() { words_.clear(); }
  /// The nodes below `count` that are not in the set, in ascending order.
  std::vector<NodeIndex> missing(std::size_t count) const {
    std::vector<NodeIndex> result;
    for (std::size_t first = 0; first < count; first += kBits) {
      std::uint64_t bits = first / kBits < words_.size() ? ~words_[first / kBits] : ~std::uint64_t{0};
      if (count - first < kBits) bits &= (std::uint64_t{1} << (count - first)) - 1;
      for (; bits != 0; bits &= bits - 1)
        result.push_back(static_cast<NodeIndex>(first + static_cast<std::size_t>(std::countr_zero(bits))));
    }
    return result;
  }
  /// The nodes in ascending order, in the fewest ranges.
  std::vector<NodeRange> ranges() const {
    std::vector<NodeRange> result;
    for (std::size_t word = 0; word < words_.size(); ++word) {
      for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1) {
        const std::size_t node = word * kBits + static_cast<std::size_t>(std::countr_zero(bits));
        if (!result.empty() && result.back().end == node)
          ++result.back().end;
        else
          result.push_back({node, node + 1});
      }
    }
    return result;
  }

 private:
  static constexpr std::size_t kBits = 64;

  std::vector<std::uint64_t> words_;
};

}  // namespace rtree
