#pragma once

#include <cstddef>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/scheme.h"

namespace algebra3d::subdivision {

/// Whether a scheme can subdivide the mesh so often. Errors: invalid_value, with the edge, vertex or face; or
/// limit_exceeded. Cost: linear in the mesh.
Status check_input(const PolygonMesh& mesh, SubdivisionScheme scheme, std::size_t steps);

}  // namespace algebra3d::subdivision
