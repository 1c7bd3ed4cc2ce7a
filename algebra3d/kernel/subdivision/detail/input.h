#pragma once

#include <cstddef>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"

namespace algebra3d::subdivision {

/// Whether a scheme can subdivide the mesh so often. Errors: invalid_value, with the edge, vertex or face; or
/// limit_exceeded, also if the memory that is left cannot hold the result. Cost: linear in the mesh.
Status check_input(const PolygonMesh& mesh, const SchemeDescription& scheme, std::size_t steps, std::size_t variant);

}  // namespace algebra3d::subdivision
