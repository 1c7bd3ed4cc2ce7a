#pragma once

#include "algebra3d/values/display/shape.h"

namespace algebra3d::detail {

/// Numbers the positions of a shape in the order in which its triangles use them first, and those that no triangle uses
/// after them; `vertex_ids` holds the numbers of their vertices in the value, except for levels of detail. Renderers
/// keep the last few vertices that they transformed, so neighbouring triangles should have near numbers [sander2007].
/// Cost: linear.
void number_positions_by_use(DrawnShape& shape);

}  // namespace algebra3d::detail
