#pragma once

#include <array>

#include "algebra3d/halfedge/handle.h"
#include "algebra3d/kernel/exact/point.h"

namespace algebra3d::detail {

/// Points of a set that span the same flat as the whole set: a tetrahedron if possible, else a triangle and so on.
struct FirstSimplex {
  int dimension = -1;                 ///< of the flat; -1 for the empty set
  std::array<VertexId, 4> corners{};  ///< the first dimension + 1 of them are set
};

/// A large simplex of the points. The dimension is exact. Cost: a few passes; exact predicates for each point if the
/// set is nearly flat.
FirstSimplex first_simplex(const PointArray& points);

}  // namespace algebra3d::detail
