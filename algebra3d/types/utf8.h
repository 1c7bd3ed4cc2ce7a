#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// Position of the first byte that begins no well-formed UTF-8 sequence (overlong forms, surrogates and values beyond
/// U+10FFFF are not well-formed), or `npos` if all of `text` is well-formed. Cost: linear, fast on ASCII.
std::size_t first_invalid_utf8(std::string_view text);

/// Position of the first byte that no text of the language has, or `npos`: one that begins no well-formed UTF-8
/// sequence, or zero, where other programs that read a database would end the text.
std::size_t first_no_text(std::string_view text);
/// What is wrong with such a byte: "expected UTF-8, found the byte 0xff".
std::string no_text_message(char byte);
/// Bytes of foreign origin (names of files) as text: those that no text has become `\xff`.
std::string shown_as_text(std::string_view bytes);

/// The place behind `text`, which begins at `start`. Columns count characters.
SourcePlace place_behind(std::string_view text, SourcePlace start);

/// The longest beginning of `text` that has at most `limit` bytes and does not cut a sequence in two.
std::string_view utf8_prefix(std::string_view text, std::size_t limit);

/// True for a byte that continues a sequence, so that it is no character of its own.
inline bool is_utf8_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace algebra3d
