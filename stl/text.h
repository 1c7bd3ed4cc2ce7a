#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace stl {

/// White space of an ASCII file: blank, tab, line feed, vertical tab, form feed, carriage return.
inline bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// `text` without white space at its ends.
std::string_view trimmed(std::string_view text);

/// "1 facet", "2 facets".
std::string counted(std::size_t count, std::string_view noun);

/// What stands at the front of `text`, for a message: its first word in quotes, shortened, with unprintable bytes as
/// \xNN; or "end of file".
std::string found_text(std::string_view text);

/// Remark of both readers on facets whose normal is NaN or infinite.
std::string bad_normals_remark(std::size_t count);

/// The error of both readers when the host asks to stop.
algebra3d::Error interrupted(std::string_view file_name);

}  // namespace stl
