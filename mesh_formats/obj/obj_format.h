#pragma once

#include "mesh_formats/mesh_format.h"

namespace mesh_formats {

/// The format Wavefront OBJ. It is sure of a text whose first word is one of its keywords (`v`, `f`, `o`, `g`,
/// `mtllib`, ...).
MeshFormat obj_format();

}  // namespace mesh_formats
