#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/display/shape.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// True for types whose values have levels of detail: surfaces, solids and meshes.
bool has_levels(const Type& type);

/// Shapes of a value of such a type (asserted) with at most so many triangles, without trees. `max_triangles` descends;
/// each level is made from the one before (vertex_clustering.h). Where the value has no more triangles than that, the
/// level is its whole shape.
///
/// In a coarser level `triangle_count` is still that of the value, and `deviation` is set. Edges are all those of the
/// triangles that are shown; `boundary` and `nonmanifold` are what has become of those of the value, so that no defect
/// is shown that it has not. Parts that are smaller than the cells of the grid are points, at most `max_triangles`.
/// There are no face_ids and vertex_ids.
///
/// Errors: those of shape_of. Cost: linear.
Result<std::vector<DrawnShape>> levels_of_detail(const Value& value, std::span<const std::size_t> max_triangles,
                                                 const Monitor& monitor = {});

}  // namespace algebra3d
