#include "queries/streams/detail/box_join.h"

#include <utility>
#include <vector>

#include "algebra3d/base/work_memory.h"
#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/spatial_attribute.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;

/// Tuples with an R-tree over the boxes of one attribute: the table of a BlockJoin.
class BoxTable {
 public:
  /// Attribute numbers: `key` of the tuples in the tree, `probe` of those that look them up.
  BoxTable(std::size_t key, std::size_t probe, WindowOfBox window, const Context& context)
      : key_(key), probe_(probe), window_(std::move(window)), account_(context.memory) {}

  Result<bool> add(const TuplePtr& tuple) {
    const Box3 box = window_of(tuple->attributes[key_]);
    if (box.is_empty()) return true;
    // An entry stands once in the list and once, or nearly so, in the tree.
    if (!account_.take(heap_bytes(*tuple) + sizeof(TuplePtr) + 3 * sizeof(Entry)) && !tuples_.empty()) return false;
    entries_.push_back({box, tuples_.size()});
    tuples_.push_back(tuple);
    return true;
  }
  void finish() { tree_ = Tree::bulk_load(std::exchange(entries_, {})); }
  Status find(const Tuple& probe, std::vector<TuplePtr>& found) const {
    const Box3 box = window_of(probe.attributes[probe_]);
    if (box.is_empty()) return {};
    for (const std::uint64_t position : ids_in_window(tree_, window_(box))) found.push_back(tuples_[position]);
    return {};
  }
  void clear() {
    tuples_.clear();
    tree_ = Tree();
    account_.clear();
  }

 private:
  std::size_t key_;
  std::size_t probe_;
  WindowOfBox window_;
  algebra3d::MemoryAccount account_;
  std::vector<TuplePtr> tuples_;
  std::vector<Entry> entries_;
  Tree tree_;
};

}  // namespace

TupleStreamPtr box_join(JoinSide build, JoinSide probe, WindowOfBox window, const Context& context) {
  const auto combine = [](const Tuple& first, const Tuple& second) { return concatenated(first, second); };
  return block_join(std::move(build.stream), std::move(probe.stream),
                    BoxTable(build.attribute, probe.attribute, std::move(window), context), combine, context);
}

}  // namespace queries
