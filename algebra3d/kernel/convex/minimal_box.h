#pragma once

#include <array>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A cuboid around a set, in any orientation.
struct OrientedBox {
  TriangleMesh mesh;              ///< twelve triangles with exact corners
  std::array<Rational, 3> sizes;  ///< exact lengths of its sides, descending
  double ratio = 0;               ///< a proved upper bound of its volume by that of the smallest box
};

/// A box with nearly the smallest volume around a convex hull, which must not be empty. Its axes are an exact rotation
/// of those of the coordinates, and it contains the hull exactly; each side touches it. Undefined if a corner leaves
/// the range of doubles. Exactness: `ratio` is at most 1.05 where the search ends by itself, as for most sets; see
/// docs/enclosing-shapes.md. Errors: interrupted. Cost: linear, and up to some tenths of a second for the search.
Result<Maybe<OrientedBox>> minimal_box(const TriangleMesh& hull, const Monitor& monitor = {});

}  // namespace algebra3d
