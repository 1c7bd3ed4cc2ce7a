#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/polygon_soup.h"
#include "base/triangle_soup.h"

namespace mesh_formats {

/// The encoding of numbers: as text or in binary.
enum class Encoding { ascii, binary };

/// The type of the coordinates in a file.
enum class CoordinateRange { doubles, floats };

/// A sign that a file is incomplete: the size of a binary file contradicts its header, or a solid of an ASCII file has
/// no end.
struct WrongCount {
  std::uint64_t announced = 0;       ///< number of facets in the header
  std::uint64_t by_size = 0;         ///< number of facets by the size of the file
  std::uint64_t read = 0;            ///< number of facets read
  std::uint64_t trailing_bytes = 0;  ///< bytes after the announced facets, if fewer than a facet
  std::uint64_t missing_ends = 0;    ///< solids without `endsolid`; the other numbers are 0 then

  /// The text for people: "wrong count: header announces 24 triangles, file has 12, and may be cut short".
  [[nodiscard]] std::string text() const;
};

/// Facets as a format stores them: triangles, each with its own corners, or polygons over a list of points.
using Facets = std::variant<algebra3d::TriangleSoup, algebra3d::PolygonSoup>;

/// The content of a mesh file, in the order of the file, with remarks.
struct MeshContent {
  Facets facets;
  Encoding encoding = Encoding::binary;
  std::vector<std::string> remarks;       ///< tolerated or dropped parts, one sentence each, without the file name
  std::optional<WrongCount> wrong_count;  ///< set if there is a sign that the file is incomplete
  std::vector<std::string> unread = {};   ///< those of the remarks that are on facets of the file, or may be
};

/// True if the first kilobyte has no control characters other than white space.
bool begins_as_text(std::string_view bytes);

/// The first word after a byte order mark, white space and comments from `#`.
std::string_view first_word(std::string_view bytes);

}  // namespace mesh_formats
