#pragma once

#include <cstddef>
#include <string_view>

namespace algebra3d {

/// Position of the first byte that begins no well-formed UTF-8 sequence (overlong forms, surrogates and values beyond
/// U+10FFFF are not well-formed), or `npos` if all of `text` is well-formed. Cost: linear, fast on ASCII.
std::size_t first_invalid_utf8(std::string_view text);

/// The longest beginning of `text` that has at most `limit` bytes and does not cut a sequence in two.
std::string_view utf8_prefix(std::string_view text, std::size_t limit);

/// True for a byte that continues a sequence, so that it is no character of its own.
inline bool is_utf8_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace algebra3d
