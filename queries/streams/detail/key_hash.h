#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace queries {

/// A hash of a number: different ints, truth values or reals have different ones, and both zeros the same.
inline std::size_t hash_of_word(std::uint64_t word) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // 2^64 divided by the golden ratio
  const std::uint64_t product = word * kOdd;
  return product ^ product >> 32U;
}
inline std::size_t hash_of_number(double number) {
  return hash_of_word(std::bit_cast<std::uint64_t>(number == 0 ? 0.0 : number));
}
inline std::size_t hash_of_number(std::int64_t number) {
  return hash_of_word(static_cast<std::uint64_t>(number));
}
inline std::size_t hash_of_number(std::uint8_t truth) {
  return hash_of_word(truth);
}

}  // namespace queries
