#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/base/box3.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {

/// An R-tree over boxes of things that have ids of one kind. What it finds, and in which order, depends on the boxes
/// alone.
template <typename Id>
class IdTree {
 public:
  /// Collects the boxes of a tree.
  class Boxes {
   public:
    void reserve(std::size_t count) { entries_.reserve(count); }
    void add(const Box3& box, Id id) { entries_.push_back({box, id.index()}); }
    IdTree tree() const { return IdTree(Tree::bulk_load(entries_)); }

   private:
    friend class IdTree;
    std::vector<rtree::Entry<std::uint32_t>> entries_;
  };

  Box3 bounds() const { return tree_.bounds(); }

  /// Calls visit(id) for everything whose box meets the window.
  template <typename Visit>
  void for_each_in(const Box3& window, const Visit& visit) const {
    for (const std::uint32_t index : tree_.window(window)) visit(Id(index));
  }
  /// True if the boxes of more than `count` things meet the window. Cost: that of finding one more.
  bool has_more_in(const Box3& window, std::size_t count) const {
    auto found = tree_.window(window);
    for (std::size_t i = 0; i <= count; ++i)
      if (!found.next()) return false;
    return true;
  }
  /// Calls visit(first, second) for each pair whose boxes meet, the lower id first, until it returns false.
  template <typename Visit>
  void for_each_pair(const Visit& visit) const {
    auto pairs = tree_.self_join();
    for (auto batch = pairs.next_batch(); !batch.empty(); batch = pairs.next_batch())
      for (const auto& pair : batch)
        if (!visit(Id(pair.first), Id(pair.second))) return;
  }

 private:
  using Tree = rtree::RTree<std::uint32_t>;

  explicit IdTree(Tree tree) : tree_(std::move(tree)) {}

  Tree tree_;
};

}  // namespace algebra3d::arrangement
