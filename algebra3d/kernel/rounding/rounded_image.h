#pragma once

#include <atomic>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"

namespace algebra3d {

/// The image of a solid, rounded to doubles by the first method of rounded_solid without the exact image: each
/// coordinate is rounded once, and superfluous corners are removed. Nothing if that is not a valid volume, if two
/// vertices come to one place or a vertex to lie inside an edge or face, or if a coordinate is out of range: then the
/// exact image is to be rounded. The result is that of rounding the exact image, but for the distance, for which a
/// simpler bound is given. Domain: maps with a positive determinant. Errors: interrupted. Cost: a proof, and some 50
/// nanoseconds per vertex; exact images of points with fractions take several times as long.
Result<std::optional<RoundedSolid>> rounded_image(const AffineMap& map, const TriangleMesh& solid,
                                                  const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
