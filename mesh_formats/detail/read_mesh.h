#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/polygon_soup.h"

namespace mesh_formats {

/// The parts of a file that are read.
enum class Wanted : std::uint8_t {
  shape,
  attributes,  ///< also those of points, corners and faces (SoupAttributes)
};

/// The content of a file of indexed polygons: its points and faces in the order of the file, with remarks.
struct ReadMesh {
  algebra3d::PolygonSoup soup;       ///< every face has at least 3 corners
  std::vector<std::string> remarks;  ///< tolerated or dropped parts, one sentence each, without the file name
  std::vector<std::string> unread;   ///< as MeshContent::unread
};

}  // namespace mesh_formats
