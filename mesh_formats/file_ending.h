#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mesh_formats {

/// The ending of a file name with its dot, in lower case: ".stl"; empty for a name without one.
inline std::string file_ending(std::string_view file_name) {
  std::string ending = std::filesystem::path(file_name).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

}  // namespace mesh_formats
