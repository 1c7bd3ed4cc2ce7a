#pragma once

#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <span>

#include "rtree/detail/k_nearest.h"
#include "rtree/detail/node_scan.h"
#include "rtree/detail/translation.h"

namespace rtree {

/// A cursor over the payloads of the entries whose boxes meet a window, found on demand by `next` or as a single-pass
/// range. The order is that of the tree and depends on its history only. The tree must outlive the cursor, and changing
/// or moving it invalidates the cursor.
template <typename Leaf>
class BasicWindowCursor {
 public:
  using Payload = typename Leaf::Payload;

  class Iterator {
   public:
    using value_type = Payload;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::input_iterator_tag;

    Iterator() = default;
    explicit Iterator(BasicWindowCursor& cursor) : cursor_(&cursor), current_(cursor.next()) {}
    Payload operator*() const { return *current_; }
    Iterator& operator++() {
      current_ = cursor_->next();
      return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& it, std::default_sentinel_t) { return !it.current_.has_value(); }

   private:
    BasicWindowCursor* cursor_ = nullptr;
    std::optional<Payload> current_;
  };

  /// Domain: any window, infinite extents included; an empty one meets nothing.
  BasicWindowCursor(const TreeView<Leaf>& tree, const Box3& window);

  std::optional<Payload> next() {
    if (leaf_slots_ == 0 && !find_leaf()) return std::nullopt;
    return leaf_->reference[take_slot(leaf_slots_)];
  }
  Iterator begin() { return Iterator(*this); }
  static std::default_sentinel_t end() { return {}; }

 private:
  struct Frame {
    const InnerNode* node;
    SlotMask slots;  ///< children not yet visited
    std::uint32_t level;
  };

  bool find_leaf();
  void enter(NodeIndex node, std::uint32_t level);
  void enter_leaf(NodeIndex leaf);

  const NodeScans* scans_ = &node_scans();
  TreeView<Leaf> tree_;
  Target window_;
  const Leaf* leaf_ = nullptr;
  SlotMask leaf_slots_ = 0;
  std::uint32_t depth_ = 0;
  std::array<Frame, kMaxLevels> frames_;
};
template <typename Payload>
using WindowCursor = BasicWindowCursor<ExactLeaf<Payload>>;

/// One result of a nearest search.
template <typename Payload>
struct Neighbor {
  Payload payload;
  double distance;  ///< Euclidean, from box to box; rounded

  friend bool operator==(const Neighbor&, const Neighbor&) = default;
};

/// A cursor over entries by ascending distance from a box, then by payload; the search is incremental. Distances are
/// rounded and compared as rounded, for any size of coordinates. Distances beyond the largest double are returned as
/// infinite, but are ordered, too. Lifetime: as WindowCursor. Source: [hjaltason1999].
template <typename Leaf>
class BasicNearestCursor {
 public:
  using Payload = typename Leaf::Payload;

  /// The cursor ends after `limit` entries; a small limit saves work, which is then done at once. Domain: any box,
  /// infinite extents included; the empty box has no neighbours.
  BasicNearestCursor(const TreeView<Leaf>& tree, const Box3& box, std::size_t limit);

  std::optional<Neighbor<Payload>> next();

 private:
  // The kind of a candidate; a node of level L has the rank kNode + L.
  static constexpr std::uint32_t kExact = 0;  ///< an entry; the reference is its payload
  static constexpr std::uint32_t kEntry = 1;  ///< an entry at the distance of its keys; the reference names its slot
  static constexpr std::uint32_t kNode = 2;

  struct Candidate {
    double distance;  // or its substitute beyond the largest double
    std::uint64_t reference;
    std::uint32_t rank;

    // At the same distance exact entries come last, since others may lead to one with a smaller payload.
    bool is_after(const Candidate& other) const {
      if (distance != other.distance) return distance > other.distance;
      if (rank != other.rank) return rank < other.rank;
      return reference > other.reference;
    }
  };

  void find_all();
  void expand(NodeIndex index, std::uint32_t level);
  Candidate measured(const LeafSlot& place) const;
  void push(const Candidate& candidate);
  Candidate pop();
  Candidate take_last();
  double distance_to(const Box3& box, double square) const;
  double far_code(const Box3& to, double distance) const;

  const NodeScans* scans_ = &node_scans();
  TreeView<Leaf> tree_;
  Target target_;
  std::size_t limit_;       // number of entries still to be returned
  bool is_far_ = false;     // distances may be beyond the largest double
  bool is_sorted_ = false;  // heap_ has all results, the nearest last
  std::vector<Candidate> heap_;
};
template <typename Payload>
using NearestCursor = BasicNearestCursor<ExactLeaf<Payload>>;

/// Two entries whose boxes meet.
template <typename Payload>
struct Pair {
  Payload first;
  Payload second;

  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// A cursor over pairs of entries whose boxes meet, of two trees or within one, found on demand. Large joins are done
/// by several threads, in batches that grow; the order of the pairs does not depend on that. Lifetime: as WindowCursor,
/// for both trees. Source: [brinkhoff1993], section 4, without the plane sweep.
template <typename Leaf>
class BasicJoinCursor {
 public:
  using Payload = typename Leaf::Payload;

  /// All pairs of an entry of `first` and an entry of `second`.
  BasicJoinCursor(const TreeView<Leaf>& first, const TreeView<Leaf>& second);
  /// All pairs of different entries of one tree, each once, the smaller payload first.
  explicit BasicJoinCursor(const TreeView<Leaf>& tree);

  std::optional<Pair<Payload>> next() {
    if (position_ == pairs_.size() && !refill()) return std::nullopt;
    return pairs_[position_++];
  }
  /// The next pairs, some thousand at a time; empty at the end. Valid until the next call.
  std::span<const Pair<Payload>> next_batch() {
    if (position_ == pairs_.size() && !refill()) return {};
    const auto batch = std::span<const Pair<Payload>>(pairs_).subspan(position_);
    position_ = pairs_.size();
    return batch;
  }

 private:
  struct Task {
    NodeIndex first, second;
    std::uint32_t first_level, second_level;
  };
  using Pairs = std::vector<Pair<Payload>>;

  bool refill();
  std::vector<Task> next_tasks();
  void expand(const Task& task);
  void expand_both(const Task& task);
  void expand_self(const Task& task);
  void match(const Task& task, Pairs& pairs) const;
  void match_leaves(NodeIndex first, NodeIndex second, SlotMask rows, Pairs& pairs) const;
  void match_within(NodeIndex index, Pairs& pairs) const;
  void emit(Payload first, Payload second, Pairs& pairs) const;

  const NodeScans* scans_ = &node_scans();
  TreeView<Leaf> first_, second_;              // with keys of one frame
  TreeView<Leaf> exact_first_, exact_second_;  // as given
  std::shared_ptr<const Translation<Leaf>> translated_;
  bool within_one_;
  std::vector<Task> tasks_;
  std::size_t batch_tasks_ = 1;
  Pairs pairs_;
  std::size_t position_ = 0;
};
template <typename Payload>
using JoinCursor = BasicJoinCursor<ExactLeaf<Payload>>;

}  // namespace rtree
