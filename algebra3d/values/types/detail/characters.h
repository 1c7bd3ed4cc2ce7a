#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace algebra3d {

/// The prefix of characters or bytes for Type::order_prefix: the first eight, filled up with zeros.
inline std::uint64_t order_prefix_of(const std::string& characters) {
  std::uint64_t result = 0;
  for (std::size_t i = 0; i < sizeof result; ++i)
    result = result << 8U | (i < characters.size() ? static_cast<unsigned char>(characters[i]) : 0U);
  return result;
}

/// The heap memory of a string beside the object; short ones lie within it.
inline std::size_t heap_bytes_of(const std::string& characters) {
  constexpr std::size_t kWithinObject = 15;
  return characters.capacity() > kWithinObject ? characters.capacity() + 1 : 0;
}

}  // namespace algebra3d
