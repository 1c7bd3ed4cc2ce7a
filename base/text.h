#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// White space of a text file: blank, tab, line feed, vertical tab, form feed, carriage return.
inline bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

inline bool is_line_break(char c) {
  return c == '\n' || c == '\r';
}

/// The text without white space at its ends.
std::string_view trimmed(std::string_view text);

/// A number with its noun: "1 facet", "2 facets".
std::string counted(std::size_t count, std::string_view noun);

/// The beginning of `text` for messages: its first word in quotes, shortened, with unprintable bytes as \xNN; or "end
/// of file".
std::string found_text(std::string_view text);

/// The place of the first of two characters; npos if the text has neither. Can be interrupted.
std::size_t find_either(std::string_view text, char a, char b);

/// The text with every `from`, which is not empty, replaced by `to`.
std::string with_replaced(std::string text, std::string_view from, std::string_view to);

/// The text as one line: control characters become blanks; blanks at the ends are removed.
std::string one_line(std::string_view text);

/// Number of the line, from 1, with the byte at `offset`. Lines end at CR, LF or CRLF. Cost: linear.
std::size_t line_number(std::string_view bytes, std::size_t offset);

}  // namespace algebra3d
