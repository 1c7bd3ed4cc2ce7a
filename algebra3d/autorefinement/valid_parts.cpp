#include "algebra3d/autorefinement/valid_parts.h"

#include <utility>

#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

/// A mesh of one face, at a cost that does not depend on the mesh.
TriangleMesh mesh_of_face(const TriangleMesh& mesh, FaceId face) {
  PointArray points;
  for (const PointRef& corner : mesh.corners(face)) points.push_back(corner);
  FacePlanes planes;
  if (const IntegerPlane* plane = mesh.planes().find(face.index()); plane != nullptr) planes.set(0, planes.add(*plane));
  return {std::move(points), std::vector<TriangleMesh::Triangle>{{0, 1, 2}}, std::move(planes)};
}

}  // namespace

Result<ValidParts> ValidParts::make(const TriangleMesh& mesh, const Monitor& monitor, const FaceSet& known) {
  return make(mesh, std::vector<bool>(mesh.face_count()), monitor, known);
}

Result<ValidParts> ValidParts::make(const TriangleMesh& mesh, const std::vector<bool>& are_alone,
                                    const Monitor& monitor, const FaceSet& known) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<Entanglement> entanglements, disentangle(mesh, monitor.cancel(), known));
  ValidParts result;
  std::vector<FaceId> free;
  for (const FaceId face : faces(mesh)) {
    const Entanglement entanglement = entanglements[face.index()];
    if (entanglement == Entanglement::degenerate) continue;
    if (entanglement == Entanglement::none && !are_alone[face.index()]) {
      free.push_back(face);
      continue;
    }
    result.lone_faces_.push_back(face);
    result.meshes_.push_back(mesh_of_face(mesh, face));
  }
  if (!free.empty()) result.meshes_.push_back(submesh(mesh, free));
  result.operands_.reserve(result.meshes_.size());
  for (const TriangleMesh& part : result.meshes_) result.operands_.push_back({&part, 0});
  return result;
}

}  // namespace algebra3d
