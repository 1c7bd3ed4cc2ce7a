#pragma once

#include <string>
#include <string_view>

namespace queries {

/// The text with every `$(NAME)` replaced by the environment variable of that name, or by nothing if there is none. A
/// `$(` that is not closed stands for itself. Cost: linear.
std::string with_variables(std::string_view text);

}  // namespace queries
