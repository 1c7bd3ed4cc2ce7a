#include "stl/stl_content.h"

#include <fmt/format.h>

namespace mesh_formats {

std::string bad_normals_remark(std::size_t count) {
  return fmt::format("{} a normal that is not finite, read as zero",
                     count == 1 ? "1 facet has" : fmt::format("{} facets have", count));
}

}  // namespace mesh_formats
