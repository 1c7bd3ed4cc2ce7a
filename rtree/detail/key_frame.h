#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "algebra3d/base/box3.h"

namespace rtree {

using algebra3d::Box3;
using algebra3d::Vec3;

/// The position of a double in the order of all doubles: ordered(x) < ordered(y) if and only if x < y; both zeros are
/// 0. Domain: not NaN.
inline std::int64_t ordered(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  const std::int64_t sign = bits >> 63;
  return ((bits & INT64_MAX) ^ sign) - sign;
}
/// The double at a position; positions beyond the infinities are theirs.
inline double double_at(std::int64_t position) {
  constexpr std::int64_t kInfinity = 0x7ff0000000000000;
  position = std::clamp(position, -kInfinity, kInfinity);
  const std::int64_t sign = position >> 63;
  return std::bit_cast<double>(((position ^ sign) - sign) | (sign & INT64_MIN));
}

/// A box by the positions of its coordinates among the doubles: as exact as the box.
struct OrderedBox {
  std::int64_t min[3], max[3];

  static OrderedBox of(const Box3& box) {
    OrderedBox result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.min[axis] = ordered(box.min[axis]);
      result.max[axis] = ordered(box.max[axis]);
    }
    return result;
  }
  Box3 box() const {
    Box3 result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.min[axis] = double_at(min[axis]);
      result.max[axis] = double_at(max[axis]);
    }
    return result;
  }
  bool intersects(const OrderedBox& other) const {
    bool meets = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      meets &= (min[axis] <= other.max[axis]) & (other.min[axis] <= max[axis]);
    return meets;
  }
  void extend(const OrderedBox& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], other.min[axis]);
      max[axis] = std::max(max[axis], other.max[axis]);
    }
  }

  friend bool operator==(const OrderedBox&, const OrderedBox&) = default;
};

/// A box by the keys of its coordinates.
struct KeyBox {
  std::int32_t min[3], max[3];

  bool contains(const KeyBox& other) const {
    bool result = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      result &= (min[axis] <= other.min[axis]) & (other.max[axis] <= max[axis]);
    return result;
  }
  void extend(const KeyBox& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], other.min[axis]);
      max[axis] = std::max(max[axis], other.max[axis]);
    }
  }

  friend bool operator==(const KeyBox&, const KeyBox&) = default;
};

/// The map from the coordinates on one axis to keys of 32 bits: the position among the doubles without its lowest
/// `shift` bits, less `base`. It is monotone, and coordinates beyond its range have the first or the last key. So keys
/// in strict order prove the order of the coordinates, and only equal keys leave it open.
struct AxisFrame {
  std::int64_t base = 0;
  std::uint32_t shift = 32;  // at most 32, where base is 0 and the range is that of all doubles

  /// The map with the best resolution whose range has all positions from `low` to `high`; the shift is not less than
  /// `least_shift`.
  static AxisFrame of(std::int64_t low, std::int64_t high, std::uint32_t least_shift = 0);

  /// True for the frames that `of` gives: all positions in the range are within 64 bits.
  bool is_valid() const {
    if (shift >= 32) return shift == 32 && base == 0;
    const std::int64_t least = INT64_MIN >> shift, greatest = (INT64_MAX >> shift) - UINT32_MAX;
    return base >= least - INT32_MIN && base <= greatest - INT32_MIN;
  }
  std::int64_t first() const { return (base + INT32_MIN) << shift; }
  // The key INT32_MAX is that of no coordinate: it is the least one of an unused slot, which no box meets.
  std::int64_t last() const { return ((base + INT32_MAX) << shift) - 1; }
  bool has(std::int64_t position) const { return first() <= position && position <= last(); }

  /// Domain: a position in the range.
  std::int32_t key_in_range(std::int64_t position) const {
    return static_cast<std::int32_t>((position >> shift) - base);
  }
  std::int32_t key(std::int64_t position) const { return key_in_range(std::clamp(position, first(), last())); }
  /// The part of a position in the range that the key leaves out.
  std::uint32_t remainder(std::int64_t position) const { return static_cast<std::uint32_t>(position & remainders()); }
  /// The least and the greatest position with this key; `remainder` is between 0 and remainders().
  std::int64_t position(std::int32_t key, std::int64_t remainder) const { return ((key + base) << shift) + remainder; }
  std::int64_t remainders() const { return (std::int64_t{1} << shift) - 1; }

  friend bool operator==(const AxisFrame&, const AxisFrame&) = default;
};

/// The maps of the three axes.
struct KeyFrame {
  AxisFrame axes[3];

  /// For the boxes inside of `bounds`.
  static KeyFrame of(const OrderedBox& bounds);
  bool has(const OrderedBox& box) const;
  /// A frame with coarser keys whose range has this one's and `box`: at least twice as large on each axis that lacked
  /// it.
  KeyFrame widened(const OrderedBox& box) const;
  KeyBox keys(const OrderedBox& box) const;
  /// Domain: `has(box)`.
  KeyBox keys_in_range(const OrderedBox& box) const {
    KeyBox result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.min[axis] = axes[axis].key_in_range(box.min[axis]);
      result.max[axis] = axes[axis].key_in_range(box.max[axis]);
    }
    return result;
  }
  /// The largest box with these keys.
  OrderedBox outer_box(const KeyBox& keys) const;

  friend bool operator==(const KeyFrame&, const KeyFrame&) = default;
};

}  // namespace rtree
