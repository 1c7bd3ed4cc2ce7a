#pragma once

#include <cstdint>

namespace algebra3d {

/// Maximum number of bits of a coordinate of a Morton code.
inline constexpr unsigned kMortonBits = 21;

namespace detail {

/// The bits of a number of kMortonBits bits, with two zeros before each.
constexpr std::uint64_t spread_for_morton(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x001F00000000FFFFU;
  bits = (bits | bits << 16U) & 0x001F0000FF0000FFU;
  bits = (bits | bits << 8U) & 0x100F00F00F00F00FU;
  bits = (bits | bits << 4U) & 0x10C30C30C30C30C3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

}  // namespace detail

/// The Morton code of a cell, whose coordinates have kMortonBits bits at most: their bits in turn, those of x lowest.
constexpr std::uint64_t morton_code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return detail::spread_for_morton(x) | detail::spread_for_morton(y) << 1U | detail::spread_for_morton(z) << 2U;
}

}  // namespace algebra3d
