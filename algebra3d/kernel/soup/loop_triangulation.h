#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A closed loop to be triangulated.
struct Loop {
  std::vector<Vec3> corners;  ///< in order
  /// Per edge, from corner i to the next: the third corner of the triangle beyond it, or corner i if there is none.
  std::vector<Vec3> beyond;
};

/// The measure that a triangulation of a loop minimises.
enum class LoopMeasure {
  bend,  ///< the largest angle between neighbouring triangles, those beyond the loop included; then the area
  area,
};

/// Triangulates a loop of n corners by n - 2 triangles, as indices of corners. They run along the loop in its
/// direction; none is degenerate if that is possible. The area is minimal. The bend may not be minimal for more than
/// four corners, since each part of the loop is optimised by itself. Loops of more than kMaxOptimal corners are first
/// cut into parts of at most kPartSize by relatively short diagonals. Coordinates of any size. Decisions: by rounded
/// angles and areas. Deterministic. Cost: n^3 up to kMaxOptimal corners, near-linear beyond. Source: [barequet1995],
/// [liepa2003].
std::vector<TriangleMesh::Triangle> triangulate_loop(const Loop& loop, LoopMeasure measure);
inline constexpr std::size_t kMaxOptimal = 160, kPartSize = 48;

}  // namespace algebra3d
