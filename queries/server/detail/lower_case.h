#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace queries {

/// The text with the letters A to Z as a to z: names in HTTP do not depend on case.
inline std::string in_lower_case(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace queries
