#pragma once

#include <cstddef>
#include <string>

namespace algebra3d {

/// The heap memory of a string beside the object; short ones lie within it.
inline std::size_t heap_bytes_of(const std::string& characters) {
  constexpr std::size_t kWithinObject = 15;
  return characters.capacity() > kWithinObject ? characters.capacity() + 1 : 0;
}

}  // namespace algebra3d
