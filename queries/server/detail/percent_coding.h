#pragma once

#include <string>
#include <string_view>

namespace queries {

/// The text with all bytes but letters, digits, `-`, `.` and `_` as `%` and two hexadecimal digits.
std::string percent_encoded(std::string_view text);
/// The reverse; text that is not such a code stays.
std::string percent_decoded(std::string_view text);

}  // namespace queries
