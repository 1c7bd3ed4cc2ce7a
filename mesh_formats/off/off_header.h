#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace mesh_formats {

/// The first line of an OFF file: `[ST][C][N][4][n]OFF [BINARY]`, the letters in any order.
struct OffHeader {
  bool has_texture_coordinates = false;  ///< ST: two more numbers per vertex
  bool has_colours = false;              ///< C: three or four, in binary files four
  bool has_normals = false;              ///< N: three
  bool has_weights = false;              ///< 4: one, directly after the coordinates
  bool has_dimension = false;            ///< n: a number before the counts
  bool is_binary = false;
  std::size_t bytes = 0;  ///< size of the header; in a binary file, with the end of the line
};

/// Reads the header of `bytes`, after a byte order mark, white space and comments; nothing if the first word is
/// another. A digit may follow `OFF` without a blank. The word BINARY must be the last of its line.
std::optional<OffHeader> off_header(std::string_view bytes);

}  // namespace mesh_formats
