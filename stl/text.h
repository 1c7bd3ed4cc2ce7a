#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace stl {

/// White space of a text file: blank, tab, line feed, vertical tab, form feed, carriage return.
inline bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

inline bool is_line_break(char c) {
  return c == '\n' || c == '\r';
}

/// `text` without white space at its ends.
std::string_view trimmed(std::string_view text);

/// "1 facet", "2 facets".
std::string counted(std::size_t count, std::string_view noun);

/// Appends the shortest digits that read back to the same double, without a point if there is no need of one.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::uint32_t value);

/// What stands at the front of `text`, for a message: its first word in quotes, shortened, with unprintable bytes as
/// \xNN; or "end of file".
std::string found_text(std::string_view text);

/// `text` as one line: control characters become blanks, and blanks at the ends go.
std::string one_line(std::string_view text);

/// True if `bytes` are what fills the last block of a file: NUL and Ctrl-Z (the end of a text in CP/M), or white space.
bool is_padding(std::string_view bytes);

/// Number of the line, from 1, that the byte at `offset` stands in. Lines end at CR, LF or CRLF. Cost: linear.
std::size_t line_number(std::string_view bytes, std::size_t offset);

/// Remark of both readers on facets whose normal is NaN or infinite.
std::string bad_normals_remark(std::size_t count);

/// The error of every reader when the host asks to stop.
algebra3d::Error interrupted(std::string_view file_name);

}  // namespace stl
