#pragma once

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

/// A point of the intersection of two triangles, which must not be empty: a corner of one of them if a corner is in the
/// intersection, else a crossing of an edge. Exact.
ExactPoint common_point(const TriangleRef& s, const TriangleRef& t, const SidedContact& contact);

}  // namespace algebra3d
