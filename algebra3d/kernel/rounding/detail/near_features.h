#pragma once

#include <cstddef>

#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/snapped_faces.h"

namespace algebra3d {

/// Adds to `joins` what joins features of two crossing faces that are nearer to each other than `reach`. Of the
/// following the first that applies, with all its cases: two vertices become one; an edge of either is led through a
/// vertex of either; two edges are led through a new vertex between them; a face is divided at a vertex of the other.
/// If nothing is near, an edge that pierces the other face, and that face, get a vertex where they meet. New vertices
/// are added to `faces`; they lie on the grid. False if none applies.
bool join_near_features(SnappedFaces& faces, std::size_t first, std::size_t second, double reach,
                        const CoordinateGrid& grid, FeatureJoins& joins);

/// Adds what makes a face without area, whose corners are distinct, vanish: its longest edge is led through its other
/// corner.
void join_collinear_corners(const SnappedFaces& faces, std::size_t face, FeatureJoins& joins);

}  // namespace algebra3d
