#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The faces of any mesh in sheets without tangled edges, as few as are easily found. A *tangled* edge is a
/// non-manifold one around which winding numbers may differ: it is not balanced, or its faces do not alternate
/// (EdgeOrder), or one of them is degenerate.
struct FaceSheets {
  std::vector<std::vector<FaceId>> sheets;  ///< the faces of each, ascending
  std::vector<FaceId> others;               ///< faces that are in no sheet, ascending
};

/// The faces of a mesh sorted into sheets, patch by patch: a patch has all faces that are connected across edges that
/// are not tangled. It goes to the first sheet without a face that runs along one of its tangled edges in the same
/// direction. The others are faces of one patch that run along a tangled edge in the same direction, and patches for
/// which eight sheets have no room. Exact. Deterministic. Cost: that of the exact order around non-manifold edges; else
/// linear.
FaceSheets face_sheets(const TriangleMesh& mesh);

}  // namespace algebra3d
