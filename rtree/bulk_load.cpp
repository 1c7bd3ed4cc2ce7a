#include <algorithm>
#include <array>
#include <cassert>

#include "rtree/detail/selection.h"
#include "rtree/detail/storage.h"

namespace rtree {
namespace {

// The tree is cut from the top: a node's entries are halved again and again across the longest side of their region
// until there is one part per child; docs/decisions/0003-rtree-layout.md has the measurements.

// A run of seeds that becomes one node, or several sisters as long as node_count > 1.
struct Part {
  std::size_t begin, end;
  std::size_t leaf_count;
  std::size_t node_count;
  Box3 region;  // of the centres
};

struct Task {
  Part part;
  NodeIndex parent;
  std::size_t level;
};

constexpr double kLargest = std::numeric_limits<double>::max();

// Infinite extents are cut off, so that a centre is never NaN.
double center_of(double min, double max) {
  return std::max(min, -kLargest) / 2 + std::min(max, kLargest) / 2;
}

std::size_t longest_axis(const Box3& region) {
  double longest = -1;
  std::size_t result = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = region.max[axis] / 2 - region.min[axis] / 2;
    if (length <= longest) continue;
    longest = length;
    result = axis;
  }
  return result;
}

template <typename Payload>
class Loader {
 public:
  Loader(Storage<Payload>& storage, const Entry<Payload>* entries) : storage_(storage), entries_(entries) {}

  void load(std::size_t count) {
    collect_seeds(count);
    if (seeds_.empty()) return;
    storage_.entry_count = seeds_.size();
    const std::size_t leaf_count = (seeds_.size() + kFanOut - 1) / kFanOut;
    reserve(leaf_count);
    std::size_t level = 0;
    for (std::size_t capacity = 1; capacity < leaf_count; capacity *= kFanOut) ++level;
    tasks_.push_back({{0, seeds_.size(), leaf_count, 1, {}}, kNoNode, level});
    while (!tasks_.empty()) {
      const Task task = tasks_.back();
      tasks_.pop_back();
      make_node(task);
    }
    link_parents();
  }

 private:
  void collect_seeds(std::size_t count) {
    assert(count < kNoNode);
    seeds_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Box3& box = entries_[i].box;
      if (box.is_empty()) continue;
      Seed seed{};
      for (std::size_t axis = 0; axis < 3; ++axis) seed.center[axis] = center_of(box.min[axis], box.max[axis]);
      seed.index = static_cast<std::uint32_t>(i);
      seeds_.push_back(seed);
    }
  }

  void reserve(std::size_t leaf_count) {
    // Nodes above the leaves: with two levels of them an inner node has at least 8 children, with more at least 14
    // just above the leaves and 8 further up.
    const std::size_t node_count =
        leaf_count + (leaf_count <= kFanOut * kFanOut ? leaf_count / 8 : leaf_count / 12) + 4;
    storage_.nodes.reserve(node_count);
    storage_.infos.reserve(node_count);
  }

  void make_node(const Task& task) {
    const NodeIndex node = storage_.add_node(task.level);
    storage_.infos[node].parent = task.parent;
    if (task.level == 0) return fill_leaf(node, task.part);
    cut_into_children(node, task);
  }

  // By index, so that the order within a leaf does not depend on how the selection moved the seeds.
  void fill_leaf(NodeIndex index, const Part& part) {
    std::array<std::uint32_t, kFanOut> order;
    const std::size_t count = part.end - part.begin;
    for (std::size_t i = 0; i < count; ++i) order[i] = seeds_[part.begin + i].index;
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
    Node<Payload>& leaf = storage_.nodes[index];
    for (std::size_t i = 0; i < count; ++i) leaf.set(i, entries_[order[i]]);
    storage_.infos[index].count = static_cast<std::uint16_t>(count);
  }

  // The entries lie all over the input: they are on their way while their seeds are cut into leaves.
  void prefetch_entries(const Part& part) const {
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const auto* bytes = reinterpret_cast<const char*>(&entries_[seeds_[i].index]);
      __builtin_prefetch(bytes);
      __builtin_prefetch(bytes + sizeof(Entry<Payload>) - 1);
    }
  }

  void cut_into_children(NodeIndex node, const Task& task) {
    Part whole = task.part;
    std::size_t capacity = 1;  // leaves of a full child
    for (std::size_t level = 1; level < task.level; ++level) capacity *= kFanOut;
    whole.node_count = (whole.leaf_count + capacity - 1) / capacity;
    if (task.level == 1) prefetch_entries(whole);
    whole.region = region_of(whole);
    parts_.push_back(whole);
    while (!parts_.empty()) {
      Part part = parts_.back();
      parts_.pop_back();
      if (part.node_count == 1)
        tasks_.push_back({part, node, task.level - 1});
      else
        cut(part);
    }
  }

  // The two sides get leaves in proportion to their nodes, so the nodes of a level are about equally full; each leaf is
  // full but the last, which gets at least kMinFill entries.
  void cut(const Part& part) {
    Part low = part;
    Part high = part;
    low.node_count = part.node_count / 2;
    high.node_count = part.node_count - low.node_count;
    low.leaf_count = part.leaf_count * low.node_count / part.node_count;
    high.leaf_count = part.leaf_count - low.leaf_count;
    const std::size_t count = part.end - part.begin;
    const std::size_t low_count = std::min(low.leaf_count * kFanOut, count - kMinFill);
    const std::size_t axis = longest_axis(part.region);
    select_first(seeds_.data() + part.begin, count, low_count, axis);
    low.end = high.begin = part.begin + low_count;
    const double border = largest_center(low, axis);
    low.region.max[axis] = border;
    high.region.min[axis] = border;
    parts_.push_back(high);
    parts_.push_back(low);
  }

  double largest_center(const Part& part, std::size_t axis) const {
    double largest = -Box3::kInfinity;
    for (std::size_t i = part.begin; i < part.end; ++i) largest = std::max(largest, seeds_[i].center[axis]);
    return largest;
  }

  Box3 region_of(const Part& part) const {
    Box3 region;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        region.min[axis] = std::min(region.min[axis], seeds_[i].center[axis]);
        region.max[axis] = std::max(region.max[axis], seeds_[i].center[axis]);
      }
    }
    return region;
  }

  // Children have larger indices than their parent, so backwards each node is complete when it is linked.
  void link_parents() {
    for (std::size_t i = storage_.nodes.size() - 1; i > 0; --i) {
      const auto node = static_cast<NodeIndex>(i);
      storage_.append(storage_.infos[node].parent, {storage_.bounds(node), Payload{node}});
    }
    storage_.root = 0;
  }

  Storage<Payload>& storage_;
  const Entry<Payload>* entries_;
  std::vector<Seed> seeds_;
  std::vector<Task> tasks_;
  std::vector<Part> parts_;
};

bool is_ordered(const Vec3& a, const Vec3& b) {
  return a < b;
}

template <typename Payload>
bool comes_before(const Entry<Payload>& a, const Entry<Payload>& b) {
  if (a.payload != b.payload) return a.payload < b.payload;
  return is_ordered(a.box.min, b.box.min) || (a.box.min == b.box.min && is_ordered(a.box.max, b.box.max));
}

}  // namespace

// Ties are broken by the place in the input; ordered by payload, the input gives the same tree in whatever order it
// came.
template <typename Payload>
void bulk_load(Storage<Payload>& storage, const Entry<Payload>* entries, std::size_t count) {
  assert(storage.root == kNoNode);
  if (std::is_sorted(entries, entries + count, comes_before<Payload>)) {
    Loader<Payload>(storage, entries).load(count);
    return;
  }
  std::vector<Entry<Payload>> ordered(entries, entries + count);
  std::sort(ordered.begin(), ordered.end(), comes_before<Payload>);
  Loader<Payload>(storage, ordered.data()).load(count);
}

template void bulk_load(Storage<std::uint32_t>&, const Entry<std::uint32_t>*, std::size_t);
template void bulk_load(Storage<std::uint64_t>&, const Entry<std::uint64_t>*, std::size_t);

}  // namespace rtree
