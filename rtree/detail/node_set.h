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
