#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace algebra3d {

// std::nextafter without a call, for numbers that are not NaN: most of the cost of rounding a box outward.

/// The least number above; infinity itself for infinity.
template <std::floating_point Number>
constexpr Number next_above(Number number) {
  using Bits = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
  static_assert(sizeof(Number) == sizeof(Bits));
  if (number == std::numeric_limits<Number>::infinity()) return number;
  if (number == 0) return std::bit_cast<Number>(Bits{1});
  const Bits bits = std::bit_cast<Bits>(number);
  return std::bit_cast<Number>(number > 0 ? bits + 1 : bits - 1);
}

/// The greatest number below; minus infinity itself for minus infinity.
template <std::floating_point Number>
constexpr Number next_below(Number number) {
  return -next_above(-number);
}

}  // namespace algebra3d
