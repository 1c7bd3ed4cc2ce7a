#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// How thick a solid is behind a triangle: the length of the ray from its centroid, straight inwards, to the boundary.
struct FacetThickness {
  FaceId face;
  FaceId opposite;       ///< the lowest of the triangles that the ray meets there
  double thickness = 0;  ///< rounded to nearest; infinite beyond the range of doubles
};

/// The thickness behind each triangle of a solid, in their order, in parallel. Exact, but for the rounding. Errors:
/// interrupted. Cost: that of the boxes that a ray meets on its way through the solid, for each triangle, and some
/// microseconds; tens of them more where the exact place is in question. Source: [inui2016] for the definition.
Result<std::vector<FacetThickness>> facet_thicknesses(const Volume3d& solid, const Monitor& monitor = {});

/// The centroid of a triangle, where its ray begins. Exact.
ExactPoint centroid_of(const TriangleRef& triangle);

}  // namespace algebra3d
