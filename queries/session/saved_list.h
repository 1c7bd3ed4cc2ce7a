#pragma once

#include <string_view>

namespace queries {

/// First line of what `save` writes, a comment of the nested list. In files without it, which others wrote, `$(NAME)`
/// stands for an environment variable; in ours it is data.
inline constexpr std::string_view kSavedHere = "_! saved by algebra3d; $(NAME) stands for itself !_";

/// Stands behind the expression of a derived object that had a value when it was saved: where the expression is
/// undefined when it is restored, the value would be lost. Lists of before have no such mark.
inline constexpr std::string_view kWasDefined = "defined";

}  // namespace queries
