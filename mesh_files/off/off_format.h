#pragma once

#include "mesh_files/mesh_format.h"

namespace mesh_files {

/// The format OFF. It is sure of a header line of binary OFF, and of a text that begins with `OFF` and its letters
/// (off_header).
MeshFormat off_format();

}  // namespace mesh_files
