#pragma once

#include <atomic>
#include <cstddef>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/rounding/coordinate_grid.h"

namespace algebra3d {

/// The result of feature snapping.
struct FeatureSnappedMesh {
  TriangleMesh mesh;
  double largest_displacement = 0;  ///< no point of the mesh is farther from the given one
  std::size_t crossing_pairs = 0;   ///< pairs of faces that still cross
};

/// Feature snapping: joins features of crossing faces of a closed mesh (near_features.h) in rounds, until no faces
/// cross or the crossings grow. In edges that go on crossing, farther features are joined as well, up to 32 times
/// `reach`. The result is the state with the fewest crossings. It is closed; its vertices are given ones or lie on the
/// grid, and it may have edges with more than two faces, and places with other winding numbers than 0 and 1. Domain:
/// all coordinates are doubles. Exactness: what crosses is decided exactly, what is near is not. Deterministic. Errors:
/// interrupted. Cost: a few times that of finding all crossings.
Result<FeatureSnappedMesh> snap_features(const TriangleMesh& mesh, double reach, const CoordinateGrid& grid,
                                         const std::atomic<bool>* cancel);

}  // namespace algebra3d
