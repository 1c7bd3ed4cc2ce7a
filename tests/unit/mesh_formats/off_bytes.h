#pragma once

// Binary OFF files by hand, for tests.

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace off_bytes {

enum class Order { big, little };

inline std::string words(Order order, const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (const std::uint32_t value : values)
    for (unsigned i = 0; i < 4; ++i)
      bytes += static_cast<char>((value >> (8 * (order == Order::big ? 3 - i : i))) & 0xffU);
  return bytes;
}

inline std::string floats(Order order, const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += words(order, {std::bit_cast<std::uint32_t>(value)});
  return bytes;
}

}  // namespace off_bytes
