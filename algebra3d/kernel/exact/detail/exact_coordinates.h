#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/rational.h"
#include "base/reference_count.h"

namespace algebra3d {

/// The coordinates of a point that is not a triple of doubles: x = X / W and so on, with integers, W > 0. They may have
/// a common divisor, as long as they are short; so equal points need not have equal integers. Immutable; one heap block
/// holds all integers.
class ExactCoordinates {
 public:
  /// Takes the integers, of which W may be negative, without powers of two in common, and if they are long without any
  /// common divisor. Sets `approx` to the quotients, rounded to nearest. Returns null if all quotients are doubles.
  static SharedCoordinates make(detail::HomogeneousPoint& numbers, Vec3& approx);

  ExactCoordinates(const ExactCoordinates&) = delete;
  ExactCoordinates(ExactCoordinates&&) = delete;
  ExactCoordinates& operator=(const ExactCoordinates&) = delete;
  ExactCoordinates& operator=(ExactCoordinates&&) = delete;
  ~ExactCoordinates() = default;

  /// X, Y, Z, W.
  detail::IntegerView operator[](std::size_t i) const { return numbers_[i]; }
  /// Sign of the coordinate minus its rounding; 0 if it is a double.
  int beyond(std::size_t axis) const { return beyond_[axis]; }
  Rational coordinate(std::size_t axis) const;
  /// The coordinate minus its rounding, which is given: off by 2^-51 of it at most, but for underflow. Cost: some
  /// hundred nanoseconds at the first call for an axis.
  double rest(std::size_t axis, double rounded) const;
  std::size_t heap_bytes() const;

  /// True if they are of one point; both must be of points with equal roundings.
  friend bool operator==(const ExactCoordinates& a, const ExactCoordinates& b);

 private:
  friend void add_owner(const ExactCoordinates& coordinates) noexcept;
  friend void remove_owner(const ExactCoordinates& coordinates) noexcept;
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double compute_rest(std::size_t axis, double rounded) const;
  ExactCoordinates(const detail::HomogeneousPoint& numbers, const std::array<std::int8_t, 3>& beyond);
  static const ExactCoordinates* allocate(const detail::HomogeneousPoint& numbers,
                                          const std::array<std::int8_t, 3>& beyond);

  // 32 bits are enough: each owner takes eight bytes of memory.
  mutable ReferenceCount<std::uint32_t> owners_{0};
  std::array<std::int8_t, 3> beyond_;
  // Not a number: not asked for so far. Threads that compute one at the same time get the same.
  mutable std::array<std::atomic<double>, 3> rests_{kUnknown, kUnknown, kUnknown};
  detail::PackedIntegers numbers_;  // last: the limbs follow this object
};

}  // namespace algebra3d
