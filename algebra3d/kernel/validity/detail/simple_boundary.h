#pragma once

#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// A directed edge in the plane z = 0, between two different points.
struct PlanarEdge {
  Vec3 from, to;
};

/// True if no two edges have more in common than end points of both, and the winding number of the edges, which must
/// form cycles, is 0 or 1 at every point off them: then triangles that turn counter-clockwise and whose boundary is
/// the edges do not overlap. False also if an end point lies inside an edge. Exact. Cost: a sweep, n log n for n edges,
/// and n times a copy of as many numbers as edges cross the sweep line. Source: [shamos1976].
bool bounds_simple_region(const std::vector<PlanarEdge>& edges);

}  // namespace algebra3d
