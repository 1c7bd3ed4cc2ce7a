#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// Number of axes along which a box, which is not empty, has an extent.
int dimension_of(const Box3& box);

/// The box as a solid of twelve triangles. It has three dimensions.
Volume3d solid_of_box(const Box3& box);
/// The box as a surface of two triangles. It has two dimensions.
Surface3d surface_of_box(const Box3& box);

}  // namespace algebra3d
