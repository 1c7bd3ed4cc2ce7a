#include "queries/streams/detail/box_join.h"

#include <optional>
#include <utility>
#include <vector>

#include "base/propagate.h"
#include "base/work_memory.h"
#include "queries/streams/detail/partitioned_boxes.h"
#include "queries/streams/detail/spatial_attribute.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;

/// Tuples with an R-tree over the boxes of one attribute.
class BoxTable {
 public:
  explicit BoxTable(const Context& context) : account_(context.memory) {}

  /// False if the tuple does not fit. `box` is not empty.
  bool add(const TuplePtr& tuple, const Box3& box) {
    if (!account_.take(heap_bytes(*tuple) + sizeof(TuplePtr) + kBytesOfEntry)) return false;
    entries_.push_back({box, tuples_.size()});
    tuples_.push_back(tuple);
    return true;
  }
  void finish() { tree_ = Tree::bulk_load(std::exchange(entries_, {})); }
  /// The positions of the tuples whose boxes meet the window, ascending.
  std::vector<std::uint64_t> find(const Box3& window) const { return ids_in_window(tree_, window); }
  const TuplePtr& tuple(std::size_t position) const { return tuples_[position]; }
  std::size_t size() const { return tuples_.size(); }
  /// The box of a tuple, before `finish`.
  const Box3& box(std::size_t position) const { return entries_[position].box; }
  void clear() {
    tuples_ = {};
    entries_ = {};
    account_.clear();
  }

 private:
  algebra3d::MemoryAccount account_;
  std::vector<TuplePtr> tuples_;
  std::vector<Entry> entries_;
  Tree tree_;
};

/// The pairs of two sides, or of one with itself.
class BoxPairs final : public PairStream {
 public:
  /// Without `probe`: of `build` with itself.
  BoxPairs(JoinSide build, std::optional<JoinSide> probe, WindowOfBox window, const Context& context)
      : build_(std::move(build)),
        probe_(std::move(probe)),
        window_(std::move(window)),
        context_(context),
        table_(context) {}

  Result<TuplePair> next() override {
    if (!is_begun_) A3D_TRY(begin());
    if (parts_ != nullptr) return parts_->next();
    while (position_ == found_.size()) {
      if (++steps_ % 256 == 0) A3D_TRY(context_.check_cancelled());
      A3D_ASSIGN(const bool is_there, probe_ ? begin_probe() : begin_later());
      if (!is_there) return TuplePair();
    }
    return TuplePair{table_.tuple(found_[position_++]), current_};
  }

 private:
  /// Reads the first side into memory; if it does not fit, both sides into parts.
  Status begin() {
    is_begun_ = true;
    const auto add = [this](const TuplePtr& tuple) { return add_build(tuple); };
    A3D_TRY(for_each_tuple(*build_.stream, context_, add));
    if (parts_ == nullptr) {
      table_.finish();
      return {};
    }
    const auto add_second = [this](const TuplePtr& tuple) {
      const Box3 box = window_of(tuple->attributes[probe_->attribute]);
      return box.is_empty() ? Status() : add_probe_to_parts(*tuple, box);
    };
    if (probe_) A3D_TRY(for_each_tuple(*probe_->stream, context_, add_second));
    return parts_->join();
  }

  Status add_build(const TuplePtr& tuple) {
    const Box3 box = window_of(tuple->attributes[build_.attribute]);
    if (box.is_empty()) return {};
    if (parts_ != nullptr) return add_to_parts(*tuple, box);
    if (table_.add(tuple, box)) return {};
    A3D_ASSIGN(parts_, PartitionedBoxes::make(!probe_, context_));
    for (std::size_t i = 0; i < table_.size(); ++i) A3D_TRY(add_to_parts(*table_.tuple(i), table_.box(i)));
    table_.clear();
    return add_to_parts(*tuple, box);
  }

  Status add_to_parts(const Tuple& tuple, const Box3& box) {
    A3D_TRY(parts_->add_build(tuple, box));
    return probe_ ? Status() : add_probe_to_parts(tuple, box);
  }

  Status add_probe_to_parts(const Tuple& tuple, const Box3& box) {
    const Box3 window = window_(box);
    return window.is_empty() ? Status() : parts_->add_probe(tuple, window);
  }

  /// Finds the partners of the next tuple of the second side; false at its end.
  Result<bool> begin_probe() {
    A3D_ASSIGN(current_, probe_->stream->next());
    if (current_ == nullptr) return false;
    find_partners(window_of(current_->attributes[probe_->attribute]));
    return true;
  }

  /// Finds the earlier partners of the next tuple of the one side; false at its end.
  Result<bool> begin_later() {
    if (later_ == table_.size()) return false;
    current_ = table_.tuple(later_);
    find_partners(window_of(current_->attributes[build_.attribute]));
    std::erase_if(found_, [&](std::uint64_t position) { return position >= later_; });
    ++later_;
    return true;
  }

  void find_partners(const Box3& box) {
    position_ = 0;
    found_.clear();
    if (!box.is_empty()) found_ = table_.find(window_(box));
  }

  JoinSide build_;
  std::optional<JoinSide> probe_;
  WindowOfBox window_;
  const Context& context_;
  BoxTable table_;
  std::unique_ptr<PartitionedBoxes> parts_;  // if the first side does not fit into memory
  bool is_begun_ = false;
  TuplePtr current_;
  std::size_t later_ = 0;             // of one side: the position behind that of `current_`
  std::vector<std::uint64_t> found_;  // positions of its partners
  std::size_t position_ = 0;
  std::uint32_t steps_ = 0;
};

}  // namespace

PairStreamPtr box_pairs(JoinSide build, JoinSide probe, WindowOfBox window, const Context& context) {
  return std::make_shared<BoxPairs>(std::move(build), std::move(probe), std::move(window), context);
}

PairStreamPtr box_pairs_within(JoinSide side, WindowOfBox window, const Context& context) {
  return std::make_shared<BoxPairs>(std::move(side), std::nullopt, std::move(window), context);
}

TupleStreamPtr concatenated_pairs(PairStreamPtr pairs) {
  return make_stream([pairs = std::move(pairs)]() -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePair pair, pairs->next());
    return pair.build == nullptr ? TuplePtr() : concatenated(*pair.build, *pair.probe);
  });
}

}  // namespace queries
