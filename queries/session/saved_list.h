#pragma once

#include <string_view>

namespace queries {

/// First line of what `save` writes, a comment of the nested list. In files without it, which others wrote, `$(NAME)`
/// stands for an environment variable; in ours it is data.
inline constexpr std::string_view kSavedHere = "_! saved by algebra3d; $(NAME) stands for itself !_";

}  // namespace queries
