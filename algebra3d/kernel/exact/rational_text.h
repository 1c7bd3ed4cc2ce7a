#pragma once

#include <cstddef>
#include <string_view>

namespace algebra3d {

/// Maximum number of digits, of numerator and denominator together, of a number that is stored, and by default of one
/// that is read: so stored numbers can be saved and read again.
inline constexpr std::size_t kMaxNumberDigits = 10'000'000;

/// The maximum for numbers in texts, and in bytes from elsewhere: a limit of the process, since a number of that many
/// digits is read in one piece. `set_max_digits_read` may be called at any time.
std::size_t max_digits_read();
void set_max_digits_read(std::size_t digits);

/// The number of digits of `p/q` or `p`, without a denominator of 1.
std::size_t digit_count(std::string_view text);

}  // namespace algebra3d
