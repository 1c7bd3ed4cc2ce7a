#include "queries/streams/detail/box_join.h"

#include <utility>
#include <vector>

#include "base/propagate.h"
#include "base/work_memory.h"
#include "queries/streams/detail/spatial_attribute.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;

/// Tuples with an R-tree over the boxes of one attribute: the table of BlockPairs.
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
    for (const std::uint64_t position : find_positions(probe)) found.push_back(tuples_[position]);
    return {};
  }
  void clear() {
    tuples_.clear();
    tree_ = Tree();
    account_.clear();
  }
  /// The positions in `tuples` of those that `find` finds.
  std::vector<std::uint64_t> find_positions(const Tuple& probe) const {
    const Box3 box = window_of(probe.attributes[probe_]);
    return box.is_empty() ? std::vector<std::uint64_t>() : ids_in_window(tree_, window_(box));
  }
  const std::vector<TuplePtr>& tuples() const { return tuples_; }

 private:
  std::size_t key_;
  std::size_t probe_;
  WindowOfBox window_;
  algebra3d::MemoryAccount account_;
  std::vector<TuplePtr> tuples_;
  std::vector<Entry> entries_;
  Tree tree_;
};

/// The table for a join of a stream with itself: a tuple finds the earlier ones only.
class EarlierBoxTable {
 public:
  EarlierBoxTable(std::size_t key, WindowOfBox window, const Context& context)
      : boxes_(key, key, std::move(window), context) {}

  Result<bool> add(const TuplePtr& tuple) {
    const std::size_t size = boxes_.tuples().size();
    A3D_ASSIGN(const bool has_room, boxes_.add(tuple));
    if (boxes_.tuples().size() > size) places_.push_back(added_count_);
    if (has_room) ++added_count_;
    return has_room;
  }
  void finish() {
    boxes_.finish();
    probed_count_ = 0;
  }
  Status find(const Tuple& probe, std::vector<TuplePtr>& found) {
    const std::size_t own_place = probed_count_++;
    for (const std::uint64_t position : boxes_.find_positions(probe))
      if (places_[position] < own_place) found.push_back(boxes_.tuples()[position]);
    return {};
  }
  void clear() {
    boxes_.clear();
    places_.clear();
  }

 private:
  BoxTable boxes_;
  std::vector<std::size_t> places_;  // in the stream, of the tuples in the table
  std::size_t added_count_ = 0;      // of all blocks so far
  std::size_t probed_count_ = 0;     // in this block
};

template <typename Table>
class BoxPairs final : public PairStream {
 public:
  /// `arguments` are those of BlockPairs.
  template <typename... Arguments>
  explicit BoxPairs(Arguments&&... arguments) : pairs_(std::forward<Arguments>(arguments)...) {}
  Result<TuplePair> next() override { return pairs_.next(); }

 private:
  BlockPairs<Table> pairs_;
};

}  // namespace

PairStreamPtr box_pairs(JoinSide build, JoinSide probe, WindowOfBox window, const Context& context) {
  BoxTable table(build.attribute, probe.attribute, std::move(window), context);
  return std::make_shared<BoxPairs<BoxTable>>(std::move(build.stream), std::move(probe.stream), std::move(table),
                                              context);
}

Result<PairStreamPtr> box_pairs_within(const JoinSide& side, WindowOfBox window, const Context& context) {
  A3D_ASSIGN(TupleBuffer tuples, buffered(*side.stream, context));
  TupleStreamPtr build = tuples.scan();
  EarlierBoxTable table(side.attribute, std::move(window), context);
  return PairStreamPtr(
      std::make_shared<BoxPairs<EarlierBoxTable>>(std::move(build), std::move(tuples), std::move(table), context));
}

TupleStreamPtr concatenated_pairs(PairStreamPtr pairs) {
  return make_stream([pairs = std::move(pairs)]() -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePair pair, pairs->next());
    return pair.build == nullptr ? TuplePtr() : concatenated(*pair.build, *pair.probe);
  });
}

}  // namespace queries
