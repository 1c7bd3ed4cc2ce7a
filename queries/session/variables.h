#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace queries {

/// Replaces every `$(NAME)` by the environment variable NAME, or by nothing if it is not set. A `$(` that is not closed
/// stays. Cost: linear.
std::string with_variables(std::string_view text);
/// The names that `with_variables` replaces, each once, sorted. Cost: linear.
std::vector<std::string> variables_in(std::string_view text);

}  // namespace queries
