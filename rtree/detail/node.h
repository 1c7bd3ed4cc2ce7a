#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "base/indices.h"
#include "rtree/detail/key_frame.h"

namespace rtree {

/// Number of slots of a node, for children or entries.
inline constexpr std::size_t kFanOut = 16;
/// Minimum number of used slots of a node other than the root: 40 percent, as in [beckmann1990].
inline constexpr std::size_t kMinFill = 6;
/// Upper bound of the height of a tree of 2^32 nodes.
inline constexpr std::size_t kMaxLevels = 16;

using NodeIndex = std::uint32_t;
inline constexpr NodeIndex kNoNode = algebra3d::kNone;

/// One bit per slot; bit 0 is slot 0.
using SlotMask = std::uint32_t;

/// Removes and returns the lowest slot of `slots`, which must not be empty.
inline std::size_t take_slot(SlotMask& slots) {
  // So that the compiler knows how large it is.
  const auto slot = static_cast<std::size_t>(std::countr_zero(slots)) % kFanOut;
  slots &= slots - 1;
  return slot;
}

/// A box and its reference: a payload in a leaf, the index of a child in an inner node.
template <typename Payload>
struct Entry {
  Box3 box;
  Payload payload;

  friend bool operator==(const Entry&, const Entry&) = default;
};

/// The keys of the boxes of a node, an array for each coordinate. Used slots come first; no box meets an unused one.
/// Without initial values.
struct alignas(64) KeyBoxes {
  std::int32_t min[3][kFanOut];
  std::int32_t max[3][kFanOut];

  KeyBox box(std::size_t slot) const {
    return {{min[0][slot], min[1][slot], min[2][slot]}, {max[0][slot], max[1][slot], max[2][slot]}};
  }
  void set_box(std::size_t slot, const KeyBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis][slot] = box.min[axis];
      max[axis][slot] = box.max[axis];
    }
  }
  void clear(std::size_t slot) {
    set_box(slot, {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}});
  }
  bool is_used(std::size_t slot) const { return min[0][slot] != INT32_MAX; }
  void clear() {
    for (std::size_t slot = 0; slot < kFanOut; ++slot) clear(slot);
  }
  /// Number of used slots.
  std::size_t count() const {
    std::size_t result = 0;
    while (result < kFanOut && is_used(result)) ++result;
    return result;
  }
  /// True if all slots are as `clear` leaves them.
  bool is_clear() const { return is_sound(0) && !is_used(0); }
  /// True if at least `fewest` slots are used, these come first with boxes that are not empty, and the others are as
  /// `clear` leaves them.
  bool is_sound(std::size_t fewest) const;
  /// The least box around all; that of an unused slot if there are none.
  KeyBox bounds() const {
    KeyBox result = box(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t slot = 1; slot < kFanOut; ++slot) {
        result.min[axis] = std::min(result.min[axis], min[axis][slot]);
        result.max[axis] = std::max(result.max[axis], max[axis][slot]);
      }
    }
    return result;
  }
};

/// A node: the boxes and references of its slots.
template <typename Reference>
struct Node : KeyBoxes {
  static_assert(std::is_unsigned_v<Reference>);
  using Payload = Reference;

  Reference reference[kFanOut];  ///< leaf: payload; inner node: index of the child
};
using InnerNode = Node<NodeIndex>;

/// The parts of the boxes of a leaf that its keys leave out; with them, the boxes are exact.
struct Remainders {
  std::uint32_t min[3][kFanOut];
  std::uint32_t max[3][kFanOut];

  void clear() { *this = Remainders{}; }
  void set(std::size_t slot, const OrderedBox& box, const KeyFrame& frame) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis][slot] = frame.axes[axis].remainder(box.min[axis]);
      max[axis][slot] = frame.axes[axis].remainder(box.max[axis]);
    }
  }
};

/// A leaf with exact boxes.
template <typename Payload>
struct ExactLeaf : Node<Payload> {
  Remainders remainders;
};
/// A leaf of a tree over boxes that lie elsewhere, each named by its index.
using IndexLeaf = Node<std::uint32_t>;

template <typename Leaf>
inline constexpr bool kHasRemainders = requires(Leaf leaf) {
  leaf.remainders;
};

/// The exact box of an entry.
inline OrderedBox exact_box(const KeyFrame& frame, const KeyBoxes& leaf, const Remainders& remainders,
                            std::size_t slot) {
  OrderedBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisFrame& map = frame.axes[axis];
    box.min[axis] = map.position(leaf.min[axis][slot], remainders.min[axis][slot]);
    box.max[axis] = map.position(leaf.max[axis][slot], remainders.max[axis][slot]);
  }
  return box;
}

inline void prefetch_bytes(const void* begin, std::size_t count) {
  const auto* bytes = static_cast<const char*>(begin);
  for (std::size_t line = 0; line < count; line += 64) __builtin_prefetch(bytes + line);
  if (count % 64 != 0) __builtin_prefetch(bytes + count - 1);
}
/// Prefetches a node; of a leaf not the remainders, which are seldom needed.
template <typename Reference>
inline void prefetch(const Node<Reference>& node) {
  prefetch_bytes(&node, sizeof(node));
}

}  // namespace rtree
