#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "queries/session/session.h"

namespace queries {

/// True for values whose text may be very long: geometry of any size.
bool is_large(const Value& value);

/// As the width of a table, or the length of a cell: nothing is cut.
inline constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
/// Longest text that a terminal is to show in a cell, in bytes.
inline constexpr std::size_t kLongestCell = 1000;

/// A value as people read it in a table: one line, reals with six significant digits, large values as a summary
/// (`volume3d: 12 triangles, box (0 1) (0 1) (0 1)`). Reads no geometry. Other lists are cut as `one_line` does it.
std::string display_text(const Value& value, std::size_t longest = kLongestCell);

/// Text in one line of a table: line ends are blanks, control characters are made visible, and what is longer than
/// `longest` bytes is cut and marked with `…`.
std::string one_line(std::string_view text, std::size_t longest = kLongestCell);

/// Rows of cells as an aligned table of at most `width` columns of a terminal: long cells are cut and marked with `…`.
/// Numbers stand to the right.
class TextTable {
 public:
  TextTable(std::vector<std::string> header, std::vector<bool> is_number)
      : header_(std::move(header)), is_number_(std::move(is_number)) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string print(std::size_t width) const;

 private:
  std::vector<std::size_t> column_widths(std::size_t width) const;

  std::vector<std::string> header_;
  std::vector<bool> is_number_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace queries
