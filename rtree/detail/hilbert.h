#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rtree {

/// Number of bits of each coordinate of a cell.
inline constexpr std::uint32_t kCellBits = 10;
/// Number of cells on an axis.
inline constexpr std::uint32_t kCellsOnAxis = 1U << kCellBits;

namespace hilbert_detail {

/// For a state of the curve and two bits of each coordinate, 0bxxyyzz: six bits of the code, and the next state.
struct Step {
  std::uint8_t code;
  std::uint8_t state;
};

constexpr std::uint32_t kStates = 24;  // eight entries into a cube, in three directions each

constexpr std::uint32_t rotated_left(std::uint32_t bits, std::uint32_t by) {
  return ((bits << by) | (bits >> (3 - by))) & 7;
}

// Source: [hamilton2008], sections 2.3 and 2.4, for three dimensions.
constexpr Step single_step(std::uint32_t state, std::uint32_t cell) {
  const std::uint32_t entry = state / 3, direction = state % 3;
  const std::uint32_t turned = rotated_left(cell ^ entry, (2 - direction) % 3);
  std::uint32_t code = turned ^ (turned >> 1);
  code ^= turned >> 2;
  const std::uint32_t even = code == 0 ? 0 : (code - 1) & ~1U;
  const std::uint32_t next_entry = even ^ (even >> 1);
  const std::uint32_t turning =
      code == 0 ? 0 : static_cast<std::uint32_t>(std::countr_one((code & 1) != 0 ? code : code - 1)) % 3;
  const std::uint32_t new_entry = entry ^ rotated_left(next_entry, (direction + 1) % 3);
  return {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(new_entry * 3 + (direction + turning + 1) % 3)};
}

constexpr auto make_steps() {
  std::array<std::array<Step, 64>, kStates> steps{};
  for (std::uint32_t state = 0; state < kStates; ++state) {
    for (std::uint32_t bits = 0; bits < 64; ++bits) {
      const std::uint32_t high = (bits >> 5 & 1) << 2 | (bits >> 3 & 1) << 1 | (bits >> 1 & 1);
      const std::uint32_t low = (bits >> 4 & 1) << 2 | (bits >> 2 & 1) << 1 | (bits & 1);
      const Step first = single_step(state, high);
      const Step second = single_step(first.state, low);
      steps[state][bits] = {static_cast<std::uint8_t>(first.code << 3 | second.code), second.state};
    }
  }
  return steps;
}

inline constexpr auto kSteps = make_steps();

}  // namespace hilbert_detail

/// The place of a cell on Hilbert's curve. Domain: coordinates below kCellsOnAxis.
inline std::uint32_t hilbert_code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t code = 0, state = 0;
  for (std::uint32_t bit = kCellBits; bit > 0;) {
    bit -= 2;
    const std::uint32_t bits = (x >> bit & 3) << 4 | (y >> bit & 3) << 2 | (z >> bit & 3);
    const auto step = hilbert_detail::kSteps[state][bits];
    code = code << 6 | step.code;
    state = step.state;
  }
  return code;
}

}  // namespace rtree
