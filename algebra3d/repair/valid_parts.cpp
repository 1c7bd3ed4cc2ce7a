#include "algebra3d/repair/valid_parts.h"

#include <utility>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

/// Its submesh, at a cost that does not depend on the mesh.
TriangleMesh lone_face(const TriangleMesh& mesh, std::uint32_t face) {
  PointArray points;
  for (const PointRef& corner : mesh.corners(FaceId(face))) points.push_back(corner);
  FacePlanes planes;
  if (const IntegerPlane* plane = mesh.planes().find(face); plane != nullptr) planes.set(0, planes.add(*plane));
  return {std::move(points), std::vector<TriangleMesh::Triangle>{{0, 1, 2}}, std::move(planes)};
}

}  // namespace

Result<ValidParts> ValidParts::make(const TriangleMesh& mesh, const Monitor& monitor, const FaceSet& known) {
  return make(mesh, std::vector<bool>(mesh.face_count()), monitor, known);
}

Result<ValidParts> ValidParts::make(const TriangleMesh& mesh, const std::vector<bool>& are_alone,
                                    const Monitor& monitor, const FaceSet& known) {
  ASSIGN_OR_RETURN(const std::vector<Entanglement> entanglements, disentangle(mesh, monitor.cancel(), known));
  ValidParts result;
  std::vector<FaceId> free;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (entanglements[f] == Entanglement::degenerate) continue;
    if (entanglements[f] == Entanglement::none && !are_alone[f]) {
      free.emplace_back(f);
      continue;
    }
    result.lone_faces_.emplace_back(f);
    result.meshes_.push_back(lone_face(mesh, f));
  }
  if (!free.empty()) result.meshes_.push_back(submesh(mesh, free));
  result.operands_.reserve(result.meshes_.size());
  for (const TriangleMesh& part : result.meshes_) result.operands_.push_back({&part, 0});
  return result;
}

}  // namespace algebra3d
