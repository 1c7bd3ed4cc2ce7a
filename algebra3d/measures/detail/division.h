#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {

/// True if one of two solids that overlap divides a body of the other: what is left of the body without it is not
/// connected. Exact. Errors: interrupted, limit_exceeded. Cost: that of an arrangement for each body that the other
/// solid meets.
Result<bool> do_divide(const Volume3d& a, const Volume3d& b, const Monitor& monitor);

}  // namespace algebra3d
