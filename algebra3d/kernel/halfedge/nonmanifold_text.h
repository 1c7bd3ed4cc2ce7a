#pragma once

#include <string>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"

namespace algebra3d {

/// Where a mesh is not manifold, for diagnostics: "3 non-manifold edges (first between vertices 4 and 7) and 1
/// non-manifold vertex (first 9)"; empty if it is. Vertices are numbered from 0.
std::string nonmanifold_text(const PolygonMesh& mesh);

}  // namespace algebra3d
