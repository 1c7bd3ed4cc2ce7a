#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "algebra3d/base/box3.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace rtree {

using algebra3d::Box3;
using algebra3d::Vec3;

/// Number of slots of a node, for children or entries.
inline constexpr std::size_t kFanOut = 16;
/// Minimum number of used slots of a node other than the root: 40 percent, as in [beckmann1990].
inline constexpr std::size_t kMinFill = 6;
/// Upper bound of the height of a tree of 2^32 nodes.
inline constexpr std::size_t kMaxLevels = 16;

using NodeIndex = std::uint32_t;
inline constexpr NodeIndex kNoNode = 0xffffffff;

/// One bit per slot; bit 0 is slot 0.
using SlotMask = std::uint32_t;

/// Removes and returns the lowest slot of `slots`, which must not be empty.
inline std::size_t take_slot(SlotMask& slots) {
  const auto slot = static_cast<std::size_t>(std::countr_zero(slots));
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

/// The boxes of a node, as arrays per coordinate, and their references. Used slots come first; the boxes of unused
/// slots are NaN, so comparisons never select them.
template <typename Payload>
struct alignas(64) Node {
  static_assert(std::is_unsigned_v<Payload> && sizeof(Payload) >= sizeof(NodeIndex));

  double min[3][kFanOut];
  double max[3][kFanOut];
  Payload reference[kFanOut];  ///< leaf: payload; inner node: NodeIndex of the child

  Node() {
    for (std::size_t slot = 0; slot < kFanOut; ++slot) clear(slot);
  }

  Box3 box(std::size_t slot) const {
    return {{min[0][slot], min[1][slot], min[2][slot]}, {max[0][slot], max[1][slot], max[2][slot]}};
  }
  NodeIndex child(std::size_t slot) const { return static_cast<NodeIndex>(reference[slot]); }
  Entry<Payload> entry(std::size_t slot) const { return {box(slot), reference[slot]}; }

  void set_box(std::size_t slot, const Box3& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis][slot] = box.min[axis];
      max[axis][slot] = box.max[axis];
    }
  }
  void set(std::size_t slot, const Entry<Payload>& entry) {
    set_box(slot, entry.box);
    reference[slot] = entry.payload;
  }
  void clear(std::size_t slot) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    set(slot, {{{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}}, 0});
  }
};

/// Prefetches a node.
template <typename Payload>
inline void prefetch(const Node<Payload>& node) {
  const auto* bytes = reinterpret_cast<const char*>(&node);
  for (std::size_t line = 0; line < sizeof(node); line += 64) __builtin_prefetch(bytes + line);
}

#if defined(__SSE2__)

/// The slots whose boxes meet `box`. Domain: not empty.
template <typename Payload>
inline SlotMask slots_meeting(const Node<Payload>& node, const Box3& box) {
  const __m128d low[3] = {_mm_set1_pd(box.min.x), _mm_set1_pd(box.min.y), _mm_set1_pd(box.min.z)};
  const __m128d high[3] = {_mm_set1_pd(box.max.x), _mm_set1_pd(box.max.y), _mm_set1_pd(box.max.z)};
  SlotMask slots = 0;
  for (std::size_t slot = 0; slot < kFanOut; slot += 2) {
    const auto meets_on = [&](std::size_t axis) {
      return _mm_and_pd(_mm_cmple_pd(_mm_load_pd(&node.min[axis][slot]), high[axis]),
                        _mm_cmpge_pd(_mm_load_pd(&node.max[axis][slot]), low[axis]));
    };
    const __m128d meets = _mm_and_pd(_mm_and_pd(meets_on(0), meets_on(1)), meets_on(2));
    slots |= static_cast<SlotMask>(_mm_movemask_pd(meets)) << slot;
  }
  return slots;
}

/// Squared distances from `box` to the boxes of the node; returns the used slots. A difference of two infinities counts
/// as no gap.
template <typename Payload>
inline SlotMask squared_distances(const Node<Payload>& node, const Box3& box, double (&result)[kFanOut]) {
  const __m128d zero = _mm_setzero_pd();
  SlotMask used = 0;
  for (std::size_t slot = 0; slot < kFanOut; slot += 2) {
    __m128d sum = zero;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const __m128d above = _mm_sub_pd(_mm_load_pd(&node.min[axis][slot]), _mm_set1_pd(box.max[axis]));
      const __m128d below = _mm_sub_pd(_mm_set1_pd(box.min[axis]), _mm_load_pd(&node.max[axis][slot]));
      // maxpd gives its second operand when the first is NaN.
      const __m128d gap = _mm_max_pd(above, _mm_max_pd(below, zero));
      sum = _mm_add_pd(sum, _mm_mul_pd(gap, gap));
    }
    _mm_storeu_pd(&result[slot], sum);
    const __m128d x = _mm_load_pd(&node.min[0][slot]);
    used |= static_cast<SlotMask>(_mm_movemask_pd(_mm_cmpord_pd(x, x))) << slot;
  }
  return used;
}

#else

template <typename Payload>
inline SlotMask slots_meeting(const Node<Payload>& node, const Box3& box) {
  SlotMask slots = 0;
  for (std::size_t slot = 0; slot < kFanOut; ++slot)
    slots |= static_cast<SlotMask>(node.box(slot).intersects(box)) << slot;
  return slots;
}

template <typename Payload>
inline SlotMask squared_distances(const Node<Payload>& node, const Box3& box, double (&result)[kFanOut]) {
  SlotMask used = 0;
  for (std::size_t slot = 0; slot < kFanOut; ++slot) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double above = node.min[axis][slot] - box.max[axis];
      const double below = box.min[axis] - node.max[axis][slot];
      const double gap = above > 0 ? above : below > 0 ? below : 0;
      sum += gap * gap;
    }
    result[slot] = sum;
    used |= static_cast<SlotMask>(node.min[0][slot] == node.min[0][slot]) << slot;
  }
  return used;
}

#endif

}  // namespace rtree
