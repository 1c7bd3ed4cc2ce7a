#pragma once

#include <cstddef>
#include <string>

#include "algebra3d/base/vec3.h"
#include "base/polygon_soup.h"
#include "base/triangle_soup.h"

namespace algebra3d {

/// Triangulates the polygons of a soup, in order, with the orientation of the polygons:
/// - a convex polygon (in projection along its normal) becomes a fan around its first corner;
/// - any other polygon is triangulated in the projection along the axis nearest to its normal, without overlap;
/// - a polygon that crosses itself there becomes the triangles of least total area.
/// A face of three corners becomes its triangle, even if corners repeat. In other faces, repeated adjacent corners
/// count once; a face with fewer than three corners left is dropped. Exactness: coordinates are not changed. Cost: n
/// log n for a polygon of n corners; n^3 for those that cross themselves (loop_triangulation.h).
TriangleSoup triangles_of(const PolygonSoup& polygons);

/// The polygons of a soup that are not planar, whose triangles depend on the corner at which they begin.
struct BentPolygons {
  std::size_t count = 0;
  double largest = 0;    ///< the largest distance of a corner from the plane of its polygon
  std::size_t face = 0;  ///< the face that has it
  Vec3 where;            ///< that corner

  /// "2 polygons are not planar, up to 0.25 (face 7, near (1 0 0.5))"; empty if there are none.
  std::string text() const;
};

/// Finds the polygons with a corner farther from the plane through their middle, at right angles to their vector area,
/// than the rounding noise of their size (rounding_noise.h). Rounded. Cost: linear.
BentPolygons bent_polygons(const PolygonSoup& polygons);

}  // namespace algebra3d
