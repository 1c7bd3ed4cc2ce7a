#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A closed loop that is to be covered by triangles: its corners in order, and beyond each edge (from corner i to the
/// next) the third corner of the triangle that is there already; the corner itself where there is none.
struct Loop {
  std::vector<Vec3> corners, beyond;
};

/// What counts when a loop is covered.
enum class LoopMeasure {
  bend,  ///< the largest angle between neighbouring triangles, those beyond the loop included; then the area
  area,
};

/// n - 2 triangles between the corners of the loop, by index, that cover it and run along its edges in the order of the
/// loop, none of them without area if that is possible. The area is the least of all such ways. The bend need not be,
/// for loops of more than four corners: each part of the loop bends least by itself, before it is known what lies
/// beyond the line that parts it off. Loops of more than kMaxOptimal corners are first cut, along lines that are short
/// for what they part off, into parts of at most kPartSize. Coordinates may be as large or small as doubles are.
/// Decisions: by rounded angles and areas. Deterministic. Cost: n^3 up to kMaxOptimal corners, near-linear beyond.
/// Source: [barequet1995], [liepa2003].
std::vector<TriangleMesh::Triangle> triangulate_loop(const Loop& loop, LoopMeasure measure);
inline constexpr std::size_t kMaxOptimal = 160, kPartSize = 48;

}  // namespace algebra3d
