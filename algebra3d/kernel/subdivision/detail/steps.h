#pragma once

#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/scheme.h"

namespace algebra3d::subdivision {

// One step of each scheme, on a mesh that check_input accepts, of whose coordinates it reads the doubles; `what` is the
// name of the step for people. Error: interrupted.

Result<PolygonMesh> catmull_clark_step(const PolygonMesh& mesh, const Monitor& monitor, const std::string& what);
Result<PolygonMesh> doo_sabin_step(const PolygonMesh& mesh, const Monitor& monitor, const std::string& what);
Result<PolygonMesh> loop_step(const PolygonMesh& mesh, LoopWeights weights, const Monitor& monitor,
                              const std::string& what);
Result<PolygonMesh> butterfly_step(const PolygonMesh& mesh, const Monitor& monitor, const std::string& what);
Result<PolygonMesh> modified_butterfly_step(const PolygonMesh& mesh, const Monitor& monitor, const std::string& what);

}  // namespace algebra3d::subdivision
