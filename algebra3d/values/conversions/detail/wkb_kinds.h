#pragma once

#include <cstdint>

namespace algebra3d {

/// The kinds of geometries that are read and written, by their codes.
enum class WkbKind : std::uint8_t {
  point = 1,
  line_string = 2,
  polygon = 3,
  multi_point = 4,
  multi_line_string = 5,
  multi_polygon = 6,
  geometry_collection = 7,
  polyhedral_surface = 15,
  tin = 16,
  triangle = 17,
};

/// The flags of the extended form, in the code of a type.
inline constexpr unsigned kWkbZ = 0x80000000, kWkbM = 0x40000000, kWkbSrid = 0x20000000;

}  // namespace algebra3d
