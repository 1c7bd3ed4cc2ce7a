#include "mesh_files/detail/padding.h"

#include <algorithm>

#include "algebra3d/base/text.h"

namespace mesh_files {

bool is_padding(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](char c) { return c == '\0' || c == '\x1a' || algebra3d::is_blank(c); });
}

}  // namespace mesh_files
