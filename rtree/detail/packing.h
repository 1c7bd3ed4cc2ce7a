#pragma once

#include <numeric>

#include "rtree/detail/spatial_order.h"
#include "rtree/detail/storage.h"

namespace rtree {

/// Division of a number of things into nodes: full ones, but the last has kMinFill at least.
struct Nodes {
  std::size_t item_count;

  std::size_t count() const { return (item_count + kFanOut - 1) / kFanOut; }
  std::size_t begin(std::size_t node) const {
    if (node == count()) return item_count;
    const std::size_t full = node * kFanOut;
    return node > 0 && node + 1 == count() ? std::min(full, item_count - kMinFill) : full;
  }
};

/// Bulk loading: sorts entries along a curve, cuts this into leaves, and runs of leaves into nodes above. `Source` has
/// the boxes and payloads of the input.
template <typename Payload, typename Source>
class Packing {
 public:
  Packing(Storage<Payload>& storage, const Source& source) : storage_(storage), source_(source) {}

  /// From `count` entries of the source; with the exact boxes if `are_exact`.
  void load(std::size_t count, bool are_exact) {
    const Region region = collect(count);
    storage_.entry_count = places_.size();
    if (places_.empty()) return;
    storage_.frame = KeyFrame::of(OrderedBox::of(region.boxes));
    const auto center = [this](std::size_t i) { return half_center(source_.box(i)); };
    SpatialSorter(std::span<Place>(places_), center).sort(region.centers);
    make_leaves(are_exact);
    make_inner_nodes();
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 14;
  static constexpr std::size_t kGrain = 256;

  struct Region {
    Box3 boxes, centers;
  };

  // Lists what is not empty.
  Region collect(std::size_t count) {
    assert(count <= UINT32_MAX);
    const std::size_t block_count = (count + kBlock - 1) / kBlock;
    std::vector<Region> regions(block_count);
    std::vector<std::size_t> begins(block_count + 1);
    algebra3d::parallel_for(block_count, 1, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
        const Box3& box = source_.box(i);
        if (box.is_empty()) continue;
        extend(regions[block].boxes, box);
        const Vec3 center = half_center(box);
        extend(regions[block].centers, {center, center});
        ++begins[block + 1];
      }
    });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    places_.resize(begins.back());
    algebra3d::parallel_for(block_count, 1, [&](std::size_t block) {
      std::size_t place = begins[block];
      for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i)
        if (!source_.box(i).is_empty()) places_[place++] = {0, static_cast<std::uint32_t>(i)};
    });
    Region result;
    for (const Region& region : regions) {
      extend(result.boxes, region.boxes);
      extend(result.centers, region.centers);
    }
    return result;
  }

  static void extend(Box3& box, const Box3& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], other.min[axis]);
      box.max[axis] = std::max(box.max[axis], other.max[axis]);
    }
  }

  void make_leaves(bool are_exact) {
    const Nodes nodes{places_.size()};
    storage_.leaves.resize(nodes.count());
    if (are_exact) storage_.remainders.resize(nodes.count());
    algebra3d::parallel_for(nodes.count(), kGrain, [&](std::size_t leaf) {
      prefetch_entries(nodes.begin(leaf) + 4 * kFanOut);
      fill_leaf(leaf, {nodes.begin(leaf), nodes.begin(leaf + 1)});
    });
  }

  // The entries lie all over the input: they are on their way while leaves before theirs are filled.
  void prefetch_entries(std::size_t first) const {
    for (std::size_t i = first; i < std::min(first + kFanOut, places_.size()); ++i) {
      const auto* bytes = static_cast<const char*>(source_.address(places_[i].index));
      __builtin_prefetch(bytes);
      __builtin_prefetch(bytes + sizeof(Box3) - 1);
    }
  }

  void fill_leaf(std::size_t index, std::pair<std::size_t, std::size_t> span) {
    Node<Payload>& leaf = storage_.leaves[index];
    leaf.clear();
    if (!storage_.remainders.empty()) storage_.remainders[index].clear();
    for (std::size_t i = span.first; i < span.second; ++i) {
      const std::uint32_t entry = places_[i].index;
      const OrderedBox box = OrderedBox::of(source_.box(entry));
      leaf.set_box(i - span.first, storage_.frame.keys_in_range(box));
      leaf.reference[i - span.first] = source_.payload(entry);
      if (!storage_.remainders.empty()) storage_.remainders[index].set(i - span.first, box, storage_.frame);
    }
    for (std::size_t slot = span.second - span.first; slot < kFanOut; ++slot) leaf.reference[slot] = 0;
  }

  // Level by level, and the nodes of each in a row.
  void make_inner_nodes() {
    storage_.inner.reserve(inner_count());
    std::size_t first_child = 0;
    for (Nodes nodes{storage_.leaves.size()}; nodes.item_count > 1; nodes = {nodes.count()}) {
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
    for (Nodes nodes{storage_.leaves.size()}; nodes.item_count > 1; nodes = {nodes.count()}) result += nodes.count();
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

  Storage<Payload>& storage_;
  Source source_;
  LargeVector<Place> places_;
};

}  // namespace rtree
