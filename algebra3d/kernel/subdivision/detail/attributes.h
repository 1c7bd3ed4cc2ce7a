#pragma once

#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/scheme.h"

namespace algebra3d::subdivision {

/// The attributes of `after`, the mesh after one step of a scheme, from those of the mesh before. Cost: linear; nothing
/// is computed for elements without attributes.
MeshAttributes attributes_after_step(const MeshAttributes& given, const PolygonMesh& before, const PolygonMesh& after,
                                     SubdivisionScheme scheme);

}  // namespace algebra3d::subdivision
