#pragma once

#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/values/display/shape.h"

namespace algebra3d::detail {

/// One shape with everything that the shapes draw, around the middle of them all. Faces and vertices are numbered anew:
/// those of several values have no numbers in common. Errors: limit_exceeded for more positions than 32 bits count, or
/// a box beyond the range of floats. Cost: linear.
Result<DrawnShape> joined(std::span<const DrawnShape> shapes);

}  // namespace algebra3d::detail
