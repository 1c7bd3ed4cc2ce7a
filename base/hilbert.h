#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace algebra3d {

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

/// The place of a cell on Hilbert's curve through the cells of a cube, on which cells that follow one another have a
/// side in common. The first `3 n` bits are the place of the cell of the first n bits of each coordinate. Domain: an
/// even number of bits, coordinates below two to its power, and below 2^21.
template <std::uint32_t bits>
constexpr std::uint64_t hilbert_code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  static_assert(bits % 2 == 0 && bits <= 22);
  std::uint64_t code = 0;
  std::uint32_t state = 0;
  for (std::uint32_t bit = bits; bit > 0;) {
    bit -= 2;
    const std::uint32_t two_of_each = (x >> bit & 3) << 4 | (y >> bit & 3) << 2 | (z >> bit & 3);
    const auto step = hilbert_detail::kSteps[state][two_of_each];
    code = code << 6 | step.code;
    state = step.state;
  }
  return code;
}

}  // namespace algebra3d
