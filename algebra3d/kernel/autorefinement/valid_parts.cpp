#include "algebra3d/kernel/autorefinement/valid_parts.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "algebra3d/kernel/autorefinement/detail/face_sheets.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"

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
  A3D_ASSIGN(const std::vector<Entanglement> entanglements, disentangle(mesh, monitor.cancel(), known));
  ValidParts result;
  std::vector<FaceId> free;
  for (const FaceId face : faces(mesh)) {
    const Entanglement entanglement = entanglements[face.index()];
    if (entanglement == Entanglement::degenerate) continue;
    if (entanglement == Entanglement::none && !are_alone[face.index()])
      free.push_back(face);
    else
      result.add_alone(mesh, face);
  }
  if (!free.empty()) result.meshes_.push_back(submesh(mesh, free));
  result.list_operands();
  return result;
}

Result<ValidParts> ValidParts::in_sheets(const TriangleMesh& mesh, const Monitor& monitor) {
  const FaceSheets sheets = face_sheets(mesh);
  ValidParts result;
  std::vector<TriangleMesh> free_parts;
  for (const std::vector<FaceId>& its_faces : sheets.sheets) {
    const TriangleMesh sheet = submesh(mesh, its_faces);
    A3D_ASSIGN(const std::vector<Entanglement> entanglements,
               disentangle(sheet, monitor.cancel(), {}, AllowedEdges::any));
    std::vector<FaceId> free;
    for (std::size_t i = 0; i < its_faces.size(); ++i) {
      if (entanglements[i] == Entanglement::none) free.push_back(its_faces[i]);
      if (entanglements[i] == Entanglement::entangled) result.add_alone(mesh, its_faces[i]);
    }
    if (!free.empty()) free_parts.push_back(submesh(mesh, free));
  }
  for (const FaceId face : sheets.others) {
    const TriangleRef corners = mesh.corners(face);
    if (!collinear(corners[0], corners[1], corners[2])) result.add_alone(mesh, face);
  }
  std::ranges::sort(result.lone_faces_);
  std::ranges::move(free_parts, std::back_inserter(result.meshes_));
  result.list_operands();
  return result;
}

void ValidParts::add_alone(const TriangleMesh& mesh, FaceId face) {
  lone_faces_.push_back(face);
  meshes_.push_back(mesh_of_face(mesh, face));
}

void ValidParts::list_operands() {
  operands_.reserve(meshes_.size());
  for (const TriangleMesh& part : meshes_) operands_.push_back({&part, 0});
}

}  // namespace algebra3d
