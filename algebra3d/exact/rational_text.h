#pragma once

#include <cstddef>
#include <string_view>

namespace algebra3d {

/// The limit of the digits of a number that is read as a coordinate or stored: those of numerator and denominator
/// together. The only one, so that what is stored can be saved and read again.
inline constexpr std::size_t kMaxNumberDigits = 10'000'000;

/// The length of `p/q` or `p` without sign, stroke, and a denominator of 1: what kMaxNumberDigits limits.
std::size_t digit_count(std::string_view text);

}  // namespace algebra3d
