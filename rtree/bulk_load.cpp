#include <algorithm>
#include <cassert>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "rtree/detail/spatial_order.h"
#include "rtree/detail/storage.h"

namespace rtree {
namespace {

/// Division of a number of things into nodes with `fill` of them each, but the last has kMinFill at least.
struct Nodes {
  std::size_t item_count;
  std::size_t fill;

  std::size_t count() const { return (item_count + fill - 1) / fill; }
  std::size_t begin(std::size_t node) const {
    if (node == count()) return item_count;
    const std::size_t full = node * fill;
    return node > 0 && node + 1 == count() ? std::min(full, item_count - kMinFill) : full;
  }
};

/// Bulk loading: sorts entries along a curve, cuts this into leaves, and runs of leaves into nodes above. `Source` has
/// the boxes and payloads of the input.
template <typename Leaf, typename Source>
class Packing {
 public:
  /// `fill` slots of each node are used.
  Packing(Storage<Leaf>& storage, const Source& source, std::size_t fill)
      : storage_(storage), source_(source), fill_(fill) {}

  /// From `count` entries of the source.
  void load(std::size_t count) {
    const Box3 region = measure(count);
    storage_.entry_count = block_begins_.back();
    if (storage_.empty()) return;
    storage_.frame = KeyFrame::of(OrderedBox::of(region));
    encode(count, CellGrid(region));
    const auto box_at = [this](std::size_t i) { return box_of(items_[i]); };
    SpatialSorter(std::span<Place>(places_), box_at).sort();
    make_leaves();
    make_inner_nodes();
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 14;
  static constexpr std::size_t kGrain = 256;

  using Payload = typename Leaf::Payload;

  // All that a leaf gets of an entry, on one line of the cache.
  struct alignas(32) IndexItem {
    KeyBox keys;
    Payload payload;
  };
  struct alignas(64) ExactItem {
    KeyBox keys;
    std::uint32_t min_remainder[3], max_remainder[3];
    Payload payload;
  };
  using Item = std::conditional_t<kHasRemainders<Leaf>, ExactItem, IndexItem>;

  // The box around all, and how many of each block are not empty.
  Box3 measure(std::size_t count) {
    assert(count <= UINT32_MAX);
    const std::size_t block_count = (count + kBlock - 1) / kBlock;
    std::vector<Box3> regions(block_count);
    block_begins_.resize(block_count + 1);
    algebra3d::parallel_for(block_count, 1, [&](std::size_t block) {
      Box3 region;
      std::size_t used = 0;
      for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
        const Box3& box = source_.box(i);
        prefetch_source(i, count);
        if (box.is_empty()) continue;
        ++used;
        extend(region, box);
      }
      regions[block] = region;
      block_begins_[block + 1] = used;
    });
    std::partial_sum(block_begins_.begin(), block_begins_.end(), block_begins_.begin());
    Box3 result;
    for (const Box3& region : regions) extend(result, region);
    return result;
  }

  // The processor itself does not look ahead beyond a page of the input.
  void prefetch_source(std::size_t i, std::size_t count) const {
    constexpr std::size_t kAhead = 32;
    __builtin_prefetch(&source_.box(std::min(i + kAhead, count - 1)));
  }

  static void extend(Box3& box, const Box3& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], other.min[axis]);
      box.max[axis] = std::max(box.max[axis], other.max[axis]);
    }
  }

  // Lists what is not empty, with its keys: later these are read in the order of the tree, which is not an order in
  // memory, and the boxes of the input, which are larger and in smaller pages, are not.
  void encode(std::size_t count, const CellGrid& grid) {
    places_.resize(storage_.entry_count);
    items_.resize(storage_.entry_count);
    algebra3d::parallel_for(block_begins_.size() - 1, 1, [&](std::size_t block) {
      const KeyFrame frame = storage_.frame;
      std::size_t place = block_begins_[block];
      for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
        const Box3& box = source_.box(i);
        prefetch_source(i, count);
        if (box.is_empty()) continue;
        places_[place] = {grid.code(box), static_cast<std::uint32_t>(place)};
        set_item(items_[place++], OrderedBox::of(box), source_.payload(i), frame);
      }
    });
  }

  static void set_item(Item& item, const OrderedBox& box, Payload payload, const KeyFrame& frame) {
    item.keys = frame.keys_in_range(box);
    item.payload = payload;
    if constexpr (kHasRemainders<Leaf>) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        item.min_remainder[axis] = frame.axes[axis].remainder(box.min[axis]);
        item.max_remainder[axis] = frame.axes[axis].remainder(box.max[axis]);
      }
    }
  }

  Box3 box_of(const Item& item) const {
    if constexpr (kHasRemainders<Leaf>) {
      OrderedBox box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const AxisFrame& map = storage_.frame.axes[axis];
        box.min[axis] = map.position(item.keys.min[axis], item.min_remainder[axis]);
        box.max[axis] = map.position(item.keys.max[axis], item.max_remainder[axis]);
      }
      return box.box();
    } else {
      return source_.box(item.payload);
    }
  }

  void make_leaves() {
    const Nodes nodes{places_.size(), fill_};
    storage_.leaves.resize(nodes.count());
    algebra3d::parallel_for(nodes.count(), kGrain, [&](std::size_t leaf) {
      fill_leaf(leaf, nodes.begin(leaf), nodes.begin(leaf + 1) - nodes.begin(leaf));
    });
  }

  // Items lie all over their list: those of the leaves after the next ones are on their way. One at a time, since only
  // few can be on their way at once.
  void prefetch_item(std::size_t i) const {
    constexpr std::size_t kAhead = 3 * kFanOut;
    __builtin_prefetch(&items_[places_[std::min(i + kAhead, places_.size() - 1)].index]);
  }

  void fill_leaf(std::size_t index, std::size_t begin, std::size_t count) {
    Leaf& leaf = storage_.leaves[index];
    for (std::size_t slot = 0; slot < count; ++slot) {
      prefetch_item(begin + slot);
      const Item& item = items_[places_[begin + slot].index];
      leaf.set_box(slot, item.keys);
      leaf.reference[slot] = item.payload;
      if constexpr (kHasRemainders<Leaf>) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          leaf.remainders.min[axis][slot] = item.min_remainder[axis];
          leaf.remainders.max[axis][slot] = item.max_remainder[axis];
        }
      }
    }
    for (std::size_t slot = count; slot < kFanOut; ++slot) {
      leaf.KeyBoxes::clear(slot);
      leaf.reference[slot] = 0;
      if constexpr (kHasRemainders<Leaf>)
        for (std::size_t axis = 0; axis < 3; ++axis)
          leaf.remainders.min[axis][slot] = leaf.remainders.max[axis][slot] = 0;
    }
  }

  // Level by level, and the nodes of each in a row.
  void make_inner_nodes() {
    storage_.inner.reserve(inner_count());
    std::size_t first_child = 0;
    for (Nodes nodes{storage_.leaves.size(), fill_}; nodes.item_count > 1; nodes.item_count = nodes.count()) {
      const std::size_t first = storage_.inner.size();
      storage_.inner.resize(first + nodes.count());
      algebra3d::parallel_for(nodes.count(), kGrain, [&](std::size_t node) {
        fill_inner(storage_.inner[first + node], first_child, {nodes.begin(node), nodes.begin(node + 1)});
      });
      first_child = first;
      ++storage_.height;
    }
    storage_.root = storage_.height == 0 ? 0 : static_cast<NodeIndex>(storage_.inner.size() - 1);
  }

  std::size_t inner_count() const {
    std::size_t result = 0;
    for (Nodes nodes{storage_.leaves.size(), fill_}; nodes.item_count > 1; nodes.item_count = nodes.count())
      result += nodes.count();
    return result;
  }

  void fill_inner(InnerNode& node, std::size_t first_child, std::pair<std::size_t, std::size_t> span) {
    node.clear();
    for (std::size_t slot = 0; slot < kFanOut; ++slot) {
      node.reference[slot] = 0;
      if (slot >= span.second - span.first) continue;
      const auto child = static_cast<NodeIndex>(first_child + span.first + slot);
      node.set_box(slot, storage_.node(child, storage_.height).bounds());
      node.reference[slot] = child;
    }
  }

  Storage<Leaf>& storage_;
  Source source_;
  std::size_t fill_;
  std::vector<std::size_t> block_begins_;
  LargeVector<Item> items_;
  LargeVector<Place> places_;  // of items
};

bool is_ordered(const Vec3& a, const Vec3& b) {
  return a < b;
}

template <typename Payload>
bool comes_before(const Entry<Payload>& a, const Entry<Payload>& b) {
  if (a.payload != b.payload) return a.payload < b.payload;
  return is_ordered(a.box.min, b.box.min) || (a.box.min == b.box.min && is_ordered(a.box.max, b.box.max));
}

template <typename Payload>
struct EntrySource {
  const Entry<Payload>* entries;

  const Box3& box(std::size_t i) const { return entries[i].box; }
  Payload payload(std::size_t i) const { return entries[i].payload; }
};

struct BoxSource {
  const Box3* boxes;

  const Box3& box(std::size_t i) const { return boxes[i]; }
  std::uint32_t payload(std::size_t i) const { return static_cast<std::uint32_t>(i); }
};

}  // namespace

// Ties are broken by the place in the input; ordered by payload, the input gives the same tree in whatever order it
// came.
template <typename Payload>
void bulk_load(Storage<ExactLeaf<Payload>>& storage, std::span<const Entry<Payload>> entries, std::size_t fill) {
  assert(storage.empty());
  if (std::is_sorted(entries.begin(), entries.end(), comes_before<Payload>)) {
    Packing(storage, EntrySource<Payload>{entries.data()}, fill).load(entries.size());
    return;
  }
  std::vector<Entry<Payload>> ordered(entries.begin(), entries.end());
  std::sort(ordered.begin(), ordered.end(), comes_before<Payload>);
  Packing(storage, EntrySource<Payload>{ordered.data()}, fill).load(ordered.size());
}

void bulk_load(Storage<IndexLeaf>& storage, std::span<const Box3> boxes) {
  assert(storage.empty());
  Packing(storage, BoxSource{boxes.data()}, kFanOut).load(boxes.size());
}

template void bulk_load(Storage<ExactLeaf<std::uint32_t>>&, std::span<const Entry<std::uint32_t>>, std::size_t);
template void bulk_load(Storage<ExactLeaf<std::uint64_t>>&, std::span<const Entry<std::uint64_t>>, std::size_t);

}  // namespace rtree
