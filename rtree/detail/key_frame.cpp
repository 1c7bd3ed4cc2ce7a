#include "rtree/detail/key_frame.h"

namespace rtree {

AxisFrame AxisFrame::of(std::int64_t low, std::int64_t high, std::uint32_t least_shift) {
  // Bases are multiples of this, so that trees over similar sets have the same frame and can be joined as they are.
  constexpr std::int64_t kStep = std::int64_t{1} << 30;
  for (std::uint32_t shift = least_shift; shift < 32; ++shift) {
    const std::int64_t first = (low >> shift) & ~(kStep - 1);
    const AxisFrame frame{first - INT32_MIN, shift};
    // The limits on `first` keep the positions within 64 bits.
    const auto keys = static_cast<std::uint64_t>(high >> shift) - static_cast<std::uint64_t>(first);
    if (keys < UINT32_MAX && first >= (INT64_MIN >> shift) && first <= (INT64_MAX >> shift) - UINT32_MAX) return frame;
  }
  return {};
}

KeyFrame KeyFrame::of(const OrderedBox& bounds) {
  KeyFrame frame;
  for (std::size_t axis = 0; axis < 3; ++axis) frame.axes[axis] = AxisFrame::of(bounds.min[axis], bounds.max[axis]);
  return frame;
}

bool KeyFrame::has(const OrderedBox& box) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!axes[axis].has(box.min[axis]) || !axes[axis].has(box.max[axis])) return false;
  return true;
}

// Up to the next multiple of four of the shift: few steps from the keys of one double to those of all.
KeyFrame KeyFrame::widened(const OrderedBox& box) const {
  KeyFrame result = *this;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    AxisFrame& map = result.axes[axis];
    if (map.has(box.min[axis]) && map.has(box.max[axis])) continue;
    const std::int64_t low = std::min(map.first(), box.min[axis]), high = std::max(map.last(), box.max[axis]);
    map = AxisFrame::of(low, high, std::min((map.shift + 4) / 4 * 4, 32U));
  }
  return result;
}

KeyBox KeyFrame::keys(const OrderedBox& box) const {
  KeyBox result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = axes[axis].key(box.min[axis]);
    result.max[axis] = axes[axis].key(box.max[axis]);
  }
  return result;
}

OrderedBox KeyFrame::outer_box(const KeyBox& keys) const {
  OrderedBox result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = axes[axis].position(keys.min[axis], 0);
    result.max[axis] = axes[axis].position(keys.max[axis], axes[axis].remainders());
  }
  return result;
}

}  // namespace rtree
