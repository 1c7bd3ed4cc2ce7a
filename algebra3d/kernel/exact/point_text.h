#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// The point whose coordinates are written as `p/q` or `p`, decimal digits after an optional `-`; an empty text stands
/// for the coordinate of `rounded`. Nothing unless the point rounds to `rounded`, the texts that are not empty are
/// numbers that are not doubles, and there is at least one. Terms need not be lowest. Cost: below a microsecond for
/// numbers of some twenty digits with one denominator.
std::optional<ExactPoint> point_of_texts(const std::array<std::string_view, 3>& texts, const Vec3& rounded);

}  // namespace algebra3d
