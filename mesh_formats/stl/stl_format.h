#pragma once

#include "mesh_formats/mesh_format.h"

namespace mesh_formats {

/// The format STL. It is sure of a file whose size is exactly that of a binary file, whatever the header, and of a text
/// whose first word is `solid` in any case. Possible is a file that is not text in its first kilobyte and has at least
/// 84 bytes.
MeshFormat stl_format();

}  // namespace mesh_formats
