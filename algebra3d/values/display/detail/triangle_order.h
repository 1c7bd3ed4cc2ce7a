#pragma once

#include "algebra3d/values/display/shape.h"

namespace algebra3d::detail {

/// True if triangles that follow one another lie together: most blocks of a thousand triangles come after the block
/// before them in Morton order of their centres, up to a few triangles. Cost: linear.
bool is_in_spatial_order(const DrawnShape& shape);

/// Permutes the triangles of a shape into Morton order unless they are in it already, and numbers the positions as they
/// are used then; `face_ids` and `vertex_ids` follow. Cost: linear.
void bring_into_spatial_order(DrawnShape& shape);

}  // namespace algebra3d::detail
