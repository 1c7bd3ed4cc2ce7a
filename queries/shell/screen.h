#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace queries {

/// Size of a terminal in characters.
struct ScreenSize {
  std::size_t columns = 100;
  std::size_t rows = 24;
};

/// The present size of the terminal that standard output goes to; of one that does not tell, the usual size.
ScreenSize screen_size();
/// Columns that a text takes on a terminal: bytes that continue a character take none.
std::size_t display_width(std::string_view text);
/// `text` with control characters, apart from tabs and line ends, written as `\x1b`: what comes from a value, a file or
/// a message must not steer the terminal.
std::string printable(std::string_view text);

}  // namespace queries
