#pragma once

#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/exact/rational.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {

/// How thick a solid is behind a triangle: the length of the ray from its centroid, straight inwards, to the boundary.
struct FacetThickness {
  FaceId face;
  ExactPoint centroid;
  Rational squared_thickness;  ///< exact
  FaceId opposite;             ///< the lowest of the triangles that the ray meets there
};

/// The thickness behind each triangle of a solid, in their order, in parallel. Errors: interrupted. Cost: that of an
/// exact ray for each triangle, some ten microseconds and more. Source: [inui2016] for the definition.
Result<std::vector<FacetThickness>> facet_thicknesses(const Volume3d& solid, const Monitor& monitor = {});

}  // namespace algebra3d
