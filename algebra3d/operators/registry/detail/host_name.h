#pragma once

#include <string>
#include <string_view>

namespace algebra3d {

/// The name of an operator in hosts that write snake_case: "createCube" is "create_cube", "importSTL" is "import_stl",
/// "makePoint3D" is "make_point3d", and a 2 between two words is "to": "rect2region" is "rect_to_region".
std::string snake_case(std::string_view name);

/// True if a function of this name would have to be quoted in SQL, or is not possible in Python.
bool is_reserved_in_a_host(std::string_view name);

}  // namespace algebra3d
