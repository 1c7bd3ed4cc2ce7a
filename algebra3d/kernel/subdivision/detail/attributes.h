#pragma once

#include <string>
#include <vector>

#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"

namespace algebra3d::subdivision {

/// The attributes of `after`, the mesh after the step of `input`. Error: interrupted. Cost: linear; a step for each
/// attribute of vertices with numbers.
Result<MeshAttributes> attributes_after_step(const MeshAttributes& given, const StepInput& input,
                                             const PolygonMesh& after, const SchemeDescription& scheme);

/// True for numbers of vertices, which follow the points.
bool follows_points(const MeshAttribute& attribute);
/// The values as points, so that what moves points also computes values. Undefined values are NaN, which every sum with
/// them is, too; missing coordinates are 0.
std::vector<Vec3> as_points(const AttributeValues& values);
AttributeValues from_points(AttributeKind kind, const std::vector<Vec3>& points);

}  // namespace algebra3d::subdivision
