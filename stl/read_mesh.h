#pragma once

#include <string>
#include <vector>

#include "algebra3d/base/polygon_soup.h"

namespace stl {

/// What a file of indexed polygons gives: its points and faces in the order of the file, and what there is to say about
/// them.
struct ReadMesh {
  algebra3d::PolygonSoup soup;       ///< every face has at least 3 corners
  std::vector<std::string> remarks;  ///< what was tolerated or left out, one sentence each, without the file's name
};

}  // namespace stl
