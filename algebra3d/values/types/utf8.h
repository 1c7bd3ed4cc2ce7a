#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// Position of the first byte that does not begin a well-formed UTF-8 sequence (overlong forms, surrogates and values
/// beyond U+10FFFF are not well-formed), or `npos` if `text` is well-formed. Cost: linear, fast on ASCII.
std::size_t first_invalid_utf8(std::string_view text);

/// Position of the first byte that is not allowed in texts of the language, or `npos`: invalid UTF-8, or a zero byte,
/// where other programs would end the text.
std::size_t first_no_text(std::string_view text);
/// The message for such a byte: "expected UTF-8, found the byte 0xff".
std::string no_text_message(char byte);
/// Converts foreign bytes (file names) to text: bytes that are not allowed become `\xff`.
std::string shown_as_text(std::string_view bytes);

/// The position after `text`, which begins at `start`. Columns count characters.
SourcePlace place_behind(std::string_view text, SourcePlace start);

/// The longest prefix of `text` with at most `limit` bytes that does not split a sequence.
std::string_view utf8_prefix(std::string_view text, std::size_t limit);

/// True for a continuation byte of a sequence.
inline bool is_utf8_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace algebra3d
