#pragma once

#include <cstddef>
#include <string_view>

#include "algebra3d/base/error.h"

namespace queries {

/// The number of UTF-16 code units of a UTF-8 text: the unit of positions in JavaScript.
inline std::size_t utf16_units(std::string_view text) {
  std::size_t units = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) != 0x80) units += byte >= 0xF0 ? 2 : 1;
  }
  return units;
}

/// The byte at a line and column, both from 1; columns count bytes, without a byte order mark at the beginning.
inline std::size_t byte_offset(std::string_view text, const algebra3d::SourcePlace& place) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::size_t begin = place.line == 1 && text.starts_with(kMark) ? kMark.size() : 0;
  for (int line = 1; line < place.line; ++line) begin = text.find('\n', begin) + 1;
  return begin + static_cast<std::size_t>(place.column) - 1;
}

}  // namespace queries
