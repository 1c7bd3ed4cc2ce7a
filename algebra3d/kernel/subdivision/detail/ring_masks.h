#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d::subdivision {

// Masks over the points of a ring, one new point per point of the ring. Weights are sums of cosines and sines, so for
// long rings a few sums serve all new points, and the cost is linear; short rings use the weights themselves, of which
// many are exact.

/// The new corners of a face by Doo-Sabin: corner i of n weighs (n + 5) / (4 n) for itself and (3 + 2 cos(2 pi (i - j)
/// / n)) / (4 n) for corner j. Source: [doo1978].
void doo_sabin_corners(const std::vector<Vec3>& ring, std::vector<Vec3>& result);

/// The new points on the edges of an interior vertex by Modified Butterfly; `ring` has the other ends, three at least:
/// 3/4 of the vertex, and for n >= 5 neighbours (1/4 + cos(2 pi j / n) + cos(4 pi j / n) / 2) / n of the neighbour j
/// places on; 3/8, 0, -1/8, 0 for four and 5/12, -1/12, -1/12 for three neighbours. Source: [zorin1996].
void interior_edge_points(const Vec3& vertex, const std::vector<Vec3>& ring, std::vector<Vec3>& result);

/// The new points on the edges of a boundary vertex with k = ring.size() - 1 triangles, for the ring's points 1 to k -
/// 1; the first and the last are on the boundary, and their new points are not set. With t = pi / k, neighbour i has on
/// its edge 1 - sin(t) sin(i t) / (k (1 - cos(t))) of the vertex, (sin(i t) sin(j t) + sin(2 i t) sin(2 j t) / 2) / k
/// of neighbour j, and plus and minus (cos(i t) - sin(2 t) sin(2 i t) / (k (cos(t) - cos(2 t)))) / 4 of the first and
/// the last. Source: [zorin2000], chapter 4.
void boundary_edge_points(const Vec3& vertex, const std::vector<Vec3>& ring, std::vector<Vec3>& result);

}  // namespace algebra3d::subdivision
