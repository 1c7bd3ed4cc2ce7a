#pragma once

#include <string_view>

namespace queries {

/// First line of files that `save` writes, a comment in the nested list. In files with it `$(NAME)` is data; in all
/// others it stands for an environment variable.
inline constexpr std::string_view kSavedHere = "_! saved by algebra3d; $(NAME) stands for itself !_";

/// Mark after the expression of a derived object whose value was defined when it was saved. `restore` leaves the object
/// out, with an error, if the expression is undefined now. Lists of earlier versions have no mark.
inline constexpr std::string_view kWasDefined = "defined";

}  // namespace queries
