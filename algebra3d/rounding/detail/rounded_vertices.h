#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/rounding/coordinate_grid.h"
#include "algebra3d/rounding/detail/moved_points.h"

namespace algebra3d {

/// The vertices of a mesh, rounded to a grid. `movements` may be larger than a vertex moved: the function
/// rounded_vertices says why.
struct RoundedVertices : MovedVertices {
  std::size_t moved = 0;        ///< how many moved
  double largest_movement = 0;  ///< upper bound of how far any vertex moved, in coordinate units
  bool are_finite = true;       ///< otherwise a coordinate is out of range, and all else means nothing
};

/// How wide the pixels of the vertices of a mesh are. A pixel is the cube of all points that are rounded to its middle,
/// a point of the grid (hot pixels of [hobby1999]). A vertex of level 0 is rounded to the grid itself. Pixels of level
/// 1 are as wide as the largest spacing of the grid, which for floats and doubles is wider than the spacing near most
/// vertices; those of each further level are twice as wide. Crowded vertices get wider pixels, so that they merge.
struct PixelLevels {
  double spacing;           ///< the largest spacing of the grid
  std::vector<int> levels;  ///< per vertex

  /// The width of the pixel of a vertex of level 1 or more.
  double width(std::size_t vertex) const;
};

/// Rounds all vertices. The movement of a vertex with a wide pixel is at least half the diagonal of the pixel, since so
/// far other vertices may have moved to the same place.
RoundedVertices rounded_vertices(const TriangleMesh& mesh, const CoordinateGrid& grid, const PixelLevels& pixels);

/// The length slightly enlarged: an upper bound in spite of a few roundings.
double rounded_up(double length);

}  // namespace algebra3d
