#pragma once

#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/validity/contacts.h"

namespace algebra3d {

/// The mesh with faces divided at vertices that lie in them or in their edges, so that they become corners there: the
/// same points, and as valid. `contacts`: all of the mesh (vertex_contacts). The pieces of a face take its place in the
/// order. Exact. Errors: none. Cost: linear.
TriangleMesh divided_at_contacts(const TriangleMesh& mesh, const std::vector<VertexContact>& contacts);

}  // namespace algebra3d
