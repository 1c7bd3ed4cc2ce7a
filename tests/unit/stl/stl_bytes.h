#pragma once

// STL files by hand, for tests: the oracle of the reader, written without the writer.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace stl_bytes {

/// Normal, three corners: as the file has them.
using Floats = std::array<float, 12>;

inline constexpr Floats kCorner = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};

inline std::string header(std::string_view text, std::uint32_t count) {
  std::string bytes(80, '\0');
  std::copy(text.begin(), text.end(), bytes.begin());
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((count >> shift) & 0xffU);
  return bytes;
}

inline std::string facet(const Floats& floats = kCorner, std::uint16_t attribute = 0) {
  std::string bytes;
  for (const float value : floats) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xffU);
  }
  bytes += static_cast<char>(attribute & 0xffU);
  bytes += static_cast<char>(attribute >> 8U);
  return bytes;
}

inline std::string facets(std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += facet();
  return bytes;
}

inline std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

inline const std::string kAsciiFacet =
    "  facet normal 0 0 1\n"
    "    outer loop\n"
    "      vertex 0 0 0\n"
    "      vertex 1 0 0\n"
    "      vertex 0 1 0\n"
    "    endloop\n"
    "  endfacet\n";

inline const std::string kAscii = "solid part\n" + kAsciiFacet + "endsolid part\n";

}  // namespace stl_bytes
