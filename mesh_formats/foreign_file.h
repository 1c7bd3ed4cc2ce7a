#pragma once

#include <string_view>

#include "algebra3d/base/error.h"

namespace mesh_formats {

/// The kind of a file of another program, by its first bytes: "a program", "compressed by gzip", "a PNG image"; empty
/// for unknown kinds. Domain: at least the first 512 bytes of a file. Cost: constant.
std::string_view foreign_kind(std::string_view head);

/// The error file_format "prog.stl: it is a program; expected an STL, OBJ or OFF file" for the bytes of such a file;
/// `expected`: the names of the formats ("STL, OBJ or OFF"). Call it after MeshFormats::of_content, since the header of
/// a binary STL file may begin with any bytes.
algebra3d::Status refuse_foreign(std::string_view bytes, std::string_view file_name, std::string_view expected);

}  // namespace mesh_formats
