#pragma once

#include <span>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// The largest distance between equal corners that were rounded: a millionth of the diagonal, or 4 spacings of the
/// numbers of the file at the largest coordinate if that is more; both may be scaled. `points`: those of the file.
/// Their numbers are floats if each is one or has at most nine significant digits, as a float has that was written as
/// text; else doubles. Cost: linear, where the spacing of floats would decide.
double rounding_noise(double diagonal, double largest_coordinate, std::span<const Vec3> points);

}  // namespace algebra3d
