#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The faces of any mesh in sheets without non-manifold edges, as few as are easily found.
struct FaceSheets {
  std::vector<std::vector<FaceId>> sheets;  ///< the faces of each, ascending
  std::vector<FaceId> others;               ///< faces that are in no sheet, ascending
};

/// The faces of a mesh sorted into sheets, patch by patch: a patch has all faces that are connected across manifold
/// edges. It goes to the first sheet without a face that runs along one of its non-manifold edges in the same
/// direction. The others are patches that run along such an edge twice themselves, and those for which eight sheets
/// have no room. Deterministic. Cost: that of sorting the non-manifold edges of each patch; else linear.
FaceSheets face_sheets(const TriangleMesh& mesh);

}  // namespace algebra3d
