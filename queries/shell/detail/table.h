#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "queries/session/session.h"

namespace queries {

/// Width of a table or length of a cell without a limit.
inline constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
/// Maximum length of a cell on a terminal, in bytes.
inline constexpr std::size_t kLongestCell = 1000;

/// A value as text for a table: one line, reals with six significant digits, large values as a summary (`volume3d: 12
/// triangles, box (0 1) (0 1) (0 1)`). Does not load geometry. Other lists are cut by `one_line`.
std::string display_text(const Value& value, std::size_t longest = kLongestCell);

/// Text for one line of a table: line ends become blanks, control characters are escaped, and text beyond `longest`
/// bytes is cut and marked with `…`.
std::string one_line(std::string_view text, std::size_t longest = kLongestCell);

/// An aligned table of at most `width` columns of a terminal: long cells are cut and marked with `…`. Numbers are
/// right-aligned.
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
