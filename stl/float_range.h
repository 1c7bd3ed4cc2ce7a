#pragma once

namespace stl {

/// Doubles from here on round to infinity as floats: the greatest float plus half a unit in its last place.
inline constexpr double kBeyondFloat = 0x1.ffffffp127;

}  // namespace stl
