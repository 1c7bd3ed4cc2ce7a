#pragma once

#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// The error for a place that names `what` itself: without it, if the subject begins with it.
Error without_subject(Error error, std::string_view what);

/// The error of a text in a file, with the name of the file before the place in it: "storms.csv line 3: ...".
Error in_text_of(std::string_view file_name, Error error);

}  // namespace algebra3d
