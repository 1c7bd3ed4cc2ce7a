#pragma once

#include "algebra3d/base/error.h"

// The short names that the tree uses for the two macros with which errors travel to the caller. They are not part of
// the headers for users, which have the long names only. NOLINTBEGIN(cppcoreguidelines-macro-usage)

/// Returns the error of `expression` (a Status or Result), if it has one, from the function.
#define A3D_TRY(expression) ALGEBRA3D_RETURN_IF_ERROR(expression)

/// Assigns the value of `expression` (a Result) to `target`, or returns its error from the function.
#define A3D_ASSIGN(target, expression) ALGEBRA3D_ASSIGN_OR_RETURN(target, expression)
// NOLINTEND(cppcoreguidelines-macro-usage)
