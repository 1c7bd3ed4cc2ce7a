#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace stl {

/// What the first line of an OFF file says: `[ST][C][N][4][n]OFF [BINARY]`, the letters in any order.
struct OffHeader {
  bool has_texture_coordinates = false;  ///< ST: two numbers more per vertex
  bool has_colours = false;              ///< C: three or four, in binary files four
  bool has_normals = false;              ///< N: three
  bool has_weights = false;              ///< 4: one, right behind the coordinates
  bool has_dimension = false;            ///< n: a number before the counts
  bool is_binary = false;
  std::size_t bytes = 0;  ///< where what follows the header begins; in a binary file, behind the end of the line
};

/// The header of `bytes`, behind a byte order mark, white space and comments; or nothing, if its first word is another.
/// A digit may follow `OFF` without a blank. A word BINARY counts only if the line ends behind it.
std::optional<OffHeader> off_header(std::string_view bytes);

}  // namespace stl
