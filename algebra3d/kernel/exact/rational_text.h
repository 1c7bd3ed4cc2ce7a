#pragma once

#include <cstddef>
#include <string_view>

namespace algebra3d {

/// Maximum number of digits, of numerator and denominator together, of a number that is read or stored. There is only
/// this limit, so stored numbers can be saved and read again.
inline constexpr std::size_t kMaxNumberDigits = 10'000'000;

/// The number of digits of `p/q` or `p`, without a denominator of 1.
std::size_t digit_count(std::string_view text);

}  // namespace algebra3d
