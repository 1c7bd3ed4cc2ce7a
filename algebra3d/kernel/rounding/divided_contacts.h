#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/validity/contacts.h"
#include "algebra3d/kernel/validity/edge_contacts.h"

namespace algebra3d {

/// The mesh with faces divided at vertices that lie in them or in their edges, so that they become corners there: the
/// same points, and as valid. `contacts`: all of the mesh (vertex_contacts). The pieces of a face take its place in the
/// order. Exact. Errors: none. Cost: linear.
TriangleMesh divided_at_contacts(const TriangleMesh& mesh, const std::vector<VertexContact>& contacts);

/// The mesh with edges that cross, and all faces along them, divided where they do, if that point is on the grid: a new
/// vertex at the end for each such point. Otherwise as above.
TriangleMesh divided_at_edge_contacts(const TriangleMesh& mesh, const std::vector<EdgeContact>& contacts,
                                      const CoordinateGrid& grid);

/// True if all coordinates of the point are numbers of the grid.
bool is_on_grid(const ExactPoint& point, const CoordinateGrid& grid);

}  // namespace algebra3d
