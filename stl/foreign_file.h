#pragma once

#include <string_view>

#include "algebra3d/base/error.h"

namespace stl {

/// What a file of another program is, by how it begins: "a program", "compressed by gzip", "a PNG image"; empty for all
/// others. Domain: the first 512 bytes of a file, or more. Cost: constant.
std::string_view foreign_kind(std::string_view head);

/// The error file_format "prog.stl: it is a program; expected an STL, OBJ or OFF file" for the bytes of such a file.
/// Ask after `format_of_content`: the header of a binary STL file may begin with anything.
algebra3d::Status refuse_foreign(std::string_view bytes, std::string_view file_name);

}  // namespace stl
