#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/triangle_soup.h"

namespace stl {

/// The two forms of an STL file.
enum class Format { ascii, binary };

/// A sign that a file is not whole: a binary one has another size than its header announces, or a solid of an ASCII one
/// has no end.
struct WrongCount {
  std::uint64_t announced = 0;       ///< facets, by the header
  std::uint64_t by_size = 0;         ///< facets that the file has room for
  std::uint64_t read = 0;            ///< facets that were read
  std::uint64_t trailing_bytes = 0;  ///< bytes after the announced facets, where they are too few for another one
  std::uint64_t missing_ends = 0;    ///< solids without `endsolid`; the other numbers are 0 then

  /// For people: "wrong count: header announces 24 triangles, file has 12, and may be cut short".
  [[nodiscard]] std::string text() const;
};

/// What an STL file gives: its facets, unwelded and in the order of the file, and what there is to say about them.
struct ReadStl {
  algebra3d::TriangleSoup soup;  ///< one normal per triangle; a normal that is not finite is passed on as zero
  Format format = Format::binary;
  std::optional<WrongCount> wrong_count;  ///< if there is a sign that the file is not whole
  std::size_t solid_count = 0;            ///< number of `solid` sections; 1 for a binary file
  std::vector<std::string> remarks;       ///< what was tolerated, one sentence each, without the file's name
};

}  // namespace stl
