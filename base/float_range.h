#pragma once

namespace mesh_formats {

/// The least double that rounds to infinity as a float: the greatest float plus half a unit in its last place.
inline constexpr double kBeyondFloat = 0x1.ffffffp127;

}  // namespace mesh_formats
