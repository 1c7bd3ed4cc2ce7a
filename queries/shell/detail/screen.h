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

/// The size of the terminal of standard output; a default size if it is unknown.
ScreenSize screen_size();
/// Width of a text on a terminal in columns; one per character.
std::size_t display_width(std::string_view text);
/// The text with control characters, except tabs and line ends, written as `\x1b`, so that values, files and messages
/// cannot control the terminal.
std::string printable(std::string_view text);
/// The text as one line: line ends, tabs and bytes that are not UTF-8, as names of files may have, are written so, too.
std::string printable_line(std::string_view text);
/// The name of a file as one word of a command for a shell, in quotes if need be.
std::string shell_word(std::string_view name);

}  // namespace queries
