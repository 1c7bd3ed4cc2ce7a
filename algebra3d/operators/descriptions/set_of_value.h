#pragma once

#include "algebra3d/values/spatial_relations/relation.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// True for the types whose values `set_of_value` takes: rect3, point3d, points3d, surface3d, volume3d, rect, point and
/// region.
bool is_set(const Type& type);

/// A value as a set of points for spatial_relations/; a value in the plane lies at z = 0. Domain: defined and loaded,
/// `is_set(value.type())`, and a box that is not empty. The set refers to the value, which must outlive it. Errors:
/// interrupted. Cost: constant, but that of a triangulation for a region.
Result<SpatialSet> set_of_value(const Value& value, const Monitor& monitor);

}  // namespace algebra3d
