#pragma once

#include <string>
#include <string_view>

namespace queries {

/// Replaces every `$(NAME)` by the environment variable NAME, or by nothing if it is not set. A `$(` that is not closed
/// stays. Cost: linear.
std::string with_variables(std::string_view text);

}  // namespace queries
