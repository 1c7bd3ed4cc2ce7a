#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

namespace algebra3d {

// Type::order_prefix of values by their C++ classes. 0 is left for undefined.

/// The two smallest numbers share a prefix.
inline std::uint64_t order_prefix_of(std::int64_t number) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(number) ^ kSign);
}

/// Doubles of one sign are in the order of their bits.
inline std::uint64_t order_prefix_of(double number) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  const auto bits = std::bit_cast<std::uint64_t>(number == 0 ? 0.0 : number);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

inline std::uint64_t order_prefix_of(bool value) {
  return value ? 2 : 1;
}

/// The first eight characters or bytes, filled up with zeros.
inline std::uint64_t order_prefix_of(const std::string& characters) {
  std::uint64_t result = 0;
  for (std::size_t i = 0; i < sizeof result; ++i)
    result = result << 8U | (i < characters.size() ? static_cast<unsigned char>(characters[i]) : 0U);
  return result;
}

}  // namespace algebra3d
