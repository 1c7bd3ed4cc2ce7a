#include "base/padding.h"

#include <algorithm>

#include "base/text.h"

namespace mesh_formats {

bool is_padding(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](char c) { return c == '\0' || c == '\x1a' || algebra3d::is_blank(c); });
}

}  // namespace mesh_formats
