#pragma once

#include "mesh_formats/mesh_format.h"

namespace mesh_formats {

/// The format OFF. It is sure of a header line of binary OFF, and of a text that begins with `OFF` and its letters
/// (off_header).
MeshFormat off_format();

}  // namespace mesh_formats
