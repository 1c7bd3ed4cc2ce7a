#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/moving_region.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"
#include "base/context.h"

namespace algebra3d {

// Images of values under affine maps. Rounding:
// - A value with double coordinates: each coordinate of the image is rounded once. If that would make a surface, solid
//   or region invalid, the exact image is kept, with a diagnostic.
// - A value with other exact coordinates: the exact image, if the matrix of the map is dyadic
//   (AffineMap::has_dyadic_matrix); else rounded as above. In a set this is decided per point.
// - A mesh3d is always valid: only the kind of its coordinates decides. A singular map flattens it, a map that mirrors
//   reverses the corners of its faces, the first one stays. Attributes are kept; vectors called Normal turn with the
//   faces and keep their length, rounded.
// Undefined if a coordinate of the image is beyond the range of doubles, and for a surface, solid or region under a
// singular map. Errors: interrupted. Maps of regions keep the plane z = 0.

Result<Maybe<Point3d>> image_of(Context& context, const AffineMap& map, const Point3d& point);
Result<Maybe<Points3d>> image_of(Context& context, const AffineMap& map, const Points3d& points);
Result<Maybe<Surface3d>> image_of(Context& context, const AffineMap& map, const Surface3d& surface);
Result<Maybe<Volume3d>> image_of(Context& context, const AffineMap& map, const Volume3d& solid);
Result<Maybe<Mesh3d>> image_of(Context& context, const AffineMap& map, const Mesh3d& mesh);
Result<Maybe<Region>> image_of(Context& context, const AffineMap& map, const Region& region);
Result<Maybe<MovingRegion>> image_of(Context& context, const AffineMap& map, const MovingRegion& moving);

/// The image with each coordinate rounded once, whether the given ones are doubles or not; nothing if that is not a
/// valid solid. Undefined and errors as above.
Result<Maybe<std::optional<Volume3d>>> rounded_image_of(Context& context, const AffineMap& map, const Volume3d& solid);
/// The exact image. Undefined and errors as above.
Result<Maybe<Volume3d>> exact_image_of(Context& context, const AffineMap& map, const Volume3d& solid);

}  // namespace algebra3d
