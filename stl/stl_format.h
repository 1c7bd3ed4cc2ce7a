#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "algebra3d/base/triangle_soup.h"

namespace stl {

/// The two forms of an STL file.
enum class Format { ascii, binary };

/// What an STL file gives: its facets, unwelded and in the order of the file, and what there is to say about them.
struct ReadStl {
  algebra3d::TriangleSoup soup;  ///< one normal per triangle; a normal that is not finite is passed on as zero
  Format format = Format::binary;
  std::size_t solid_count = 0;       ///< number of `solid` sections; 1 for a binary file
  std::vector<std::string> remarks;  ///< what was tolerated, one sentence each, without the file's name
};

}  // namespace stl
