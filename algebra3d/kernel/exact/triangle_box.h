#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

/// True if a triangle and a box have a common point; both are closed, and touching counts. The triangle must not be
/// degenerate, the box not empty. Exact. Cost: up to some fifty signs, most of which a filter decides. Source:
/// [akenine2001], the thirteen separating axes, here as signs of orient2d and orient3d.
bool meets_box(const TriangleRef& triangle, const Box3& box);

}  // namespace algebra3d
