#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"

namespace algebra3d {

/// The dual of a mesh. Vertex i is the mean of the corners of face i, each coordinate rounded once. Each closed fan of
/// three or more faces, in the order of the vertices, gives a face with its faces for corners, counter-clockwise; so
/// boundary vertices give none. Errors: interrupted. Cost: linear.
template <typename Layout>
Result<PolygonMesh> dual_mesh(const HalfedgeMesh<Layout>& mesh, const Monitor& monitor = {});

}  // namespace algebra3d
