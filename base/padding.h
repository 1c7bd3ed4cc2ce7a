#pragma once

#include <string_view>

namespace mesh_formats {

/// True if `bytes` are padding of the last block of a file: NUL and Ctrl-Z (the end of a text in CP/M), or white space.
bool is_padding(std::string_view bytes);

}  // namespace mesh_formats
