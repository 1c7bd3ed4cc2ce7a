#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/mesh_content.h"
#include "base/triangle_soup.h"

namespace mesh_formats {

/// The content of an STL file: its facets, unwelded and in the order of the file, with remarks.
struct ReadStl {
  algebra3d::TriangleSoup soup;  ///< one normal per triangle; normals that are not finite are zero
  Encoding format = Encoding::binary;
  std::optional<WrongCount> wrong_count;  ///< set if there is a sign that the file is incomplete
  std::size_t solid_count = 0;            ///< number of `solid` sections; 1 for a binary file
  std::vector<std::string> remarks;       ///< tolerated irregularities, one sentence each, without the file name
};

/// The remark of both readers on facets whose normal is NaN or infinite.
std::string bad_normals_remark(std::size_t count);

}  // namespace mesh_formats
