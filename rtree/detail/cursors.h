#pragma once

#include <array>
#include <iterator>
#include <optional>
#include <span>

#include "rtree/detail/storage.h"

namespace rtree {

/// A cursor over the payloads of the entries whose boxes meet a window, found on demand by `next` or as a single-pass
/// range. The order is that of the tree and depends on its history only. The tree must outlive the cursor, and changing
/// or moving it invalidates the cursor.
template <typename Payload>
class WindowCursor {
 public:
  class Iterator {
   public:
    using value_type = Payload;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::input_iterator_tag;

    Iterator() = default;
    explicit Iterator(WindowCursor& cursor) : cursor_(&cursor), current_(cursor.next()) {}
    Payload operator*() const { return *current_; }
    Iterator& operator++() {
      current_ = cursor_->next();
      return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& it, std::default_sentinel_t) { return !it.current_.has_value(); }

   private:
    WindowCursor* cursor_ = nullptr;
    std::optional<Payload> current_;
  };

  /// Domain: any window, infinite extents included; an empty one meets nothing.
  WindowCursor(const Storage<Payload>& storage, const Box3& window);

  std::optional<Payload> next() {
    if (leaf_slots_ == 0 && !find_leaf()) return std::nullopt;
    return leaf_->reference[take_slot(leaf_slots_)];
  }
  Iterator begin() { return Iterator(*this); }
  static std::default_sentinel_t end() { return {}; }

 private:
  struct Frame {
    const Node<Payload>* node;
    SlotMask slots;  ///< children not yet visited
    std::uint32_t level;
  };

  bool find_leaf();
  void enter(const Node<Payload>& node, std::uint32_t level);
  void prefetch_leaves(const Node<Payload>& node, SlotMask slots) const;

  const Node<Payload>* nodes_;
  const Node<Payload>* leaf_ = nullptr;
  SlotMask leaf_slots_ = 0;
  std::uint32_t depth_ = 0;
  Box3 window_;
  std::array<Frame, kMaxLevels> frames_;
};

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
template <typename Payload>
class NearestCursor {
 public:
  /// The cursor ends after `limit` entries; a limit saves work. Domain: any box, infinite extents included; the empty
  /// box has no neighbours.
  NearestCursor(const Storage<Payload>& storage, const Box3& box, std::size_t limit);

  std::optional<Neighbor<Payload>> next();

 private:
  struct Candidate {
    double distance;  // or its substitute beyond the largest double
    Payload reference;
    std::uint32_t level;  ///< 0: an entry; else one above the level of the node

    // Nodes come before entries at the same distance, since they may contain an entry with a smaller payload.
    bool is_after(const Candidate& other) const {
      if (distance != other.distance) return distance > other.distance;
      if ((level == 0) != (other.level == 0)) return level == 0;
      return reference > other.reference;
    }
  };

  void expand(NodeIndex node_index, std::uint32_t level);
  void push(const Candidate& candidate);
  Candidate pop();
  void lower_bound(double distance);
  double far_code(const Box3& to, double distance) const;

  const Storage<Payload>* storage_;
  Box3 box_;
  std::size_t limit_;               // number of entries still to be returned
  bool is_far_ = false;             // distances may be beyond the largest double
  double bound_ = Box3::kInfinity;  // farther entries cannot be among them
  double square_bound_ = Box3::kInfinity;
  std::vector<double> bounds_;   // distances of the nearest entries seen, the largest first; for small limits
  std::size_t bounds_size_ = 0;  // capacity of `bounds_`; 0: no bound is kept
  std::vector<Candidate> heap_;
};

/// Two entries whose boxes meet.
template <typename Payload>
struct Pair {
  Payload first;
  Payload second;

  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// A cursor over pairs of entries whose boxes meet, of two trees or within one, found on demand. Lifetime: as
/// WindowCursor, for both trees. Source: [brinkhoff1993], section 4, without the plane sweep.
template <typename Payload>
class JoinCursor {
 public:
  /// All pairs of an entry of `first` and an entry of `second`.
  JoinCursor(const Storage<Payload>& first, const Storage<Payload>& second);
  /// All pairs of different entries of one tree, each once, the smaller payload first.
  explicit JoinCursor(const Storage<Payload>& storage);

  std::optional<Pair<Payload>> next() {
    if (position_ == pairs_.size() && !refill()) return std::nullopt;
    return pairs_[position_++];
  }
  /// The next pairs, some hundred at a time; empty at the end. Valid until the next call.
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
    Box3 second_box;
  };

  bool refill();
  void expand(const Task& task);
  void expand_both(const Task& task);
  void expand_self(const Task& task);
  void match_leaves(const Task& task);
  void match_within(NodeIndex leaf);
  void emit(Payload first, Payload second);

  const Storage<Payload>* first_;
  const Storage<Payload>* second_;
  bool within_one_;
  std::vector<Task> tasks_;
  std::vector<Pair<Payload>> pairs_;
  std::size_t position_ = 0;
};

}  // namespace rtree
