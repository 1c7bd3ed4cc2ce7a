#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The size of the prisms over faces, and of the cubes of the lattice on which these have their corners.
struct Thickness {
  double unit;    ///< all coordinates are multiples of it, at most 2^53 of them
  double height;  ///< of the prisms above the faces, and below them, in coordinate units
};

/// A closed mesh together with a prism over each of its triangles that has an area. The prism reaches as far above the
/// triangle as below it, in the direction of the axis nearest to its normal; prisms of one direction share no walls.
/// The cells with a positive winding number are those of the mesh and those of the prisms, but for places where the
/// mesh, which may cross itself, has a negative one. So also a mesh keeps cells of which nothing else would be left.
/// Vertices are those of the mesh, and the same moved by the height along an axis. Triangles with the same corners that
/// face each other go from the mesh. Deterministic. Cost: n log n.
TriangleMesh thickened_faces(const TriangleMesh& closed, const Thickness& thickness);

}  // namespace algebra3d
