#include "algebra3d/kernel/arrangement/coplanar_facets.h"

#include <array>

#include "algebra3d/kernel/arrangement/detail/facets.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"

namespace algebra3d {

CoplanarFacets::CoplanarFacets(const TriangleMesh& mesh) : mesh_(&mesh), of_face_(mesh.face_count()) {
  const std::array<Operand, 1> operand{{{&mesh, 0}}};
  const arrangement::Operands operands(operand);
  const arrangement::Facets facets = arrangement::make_facets_of_all_faces(operands);
  faces_.reserve(mesh.face_count());
  for (const arrangement::FacetId id : facets.ids()) {
    const std::size_t first = faces_.size();
    for (const arrangement::InputFaceId face : facets.faces_of(id)) {
      faces_.emplace_back(face.index());
      of_face_[faces_.back()] = CoplanarFacetId(id.index());
    }
    facets_.push_back({first, faces_.size() - first, facets.plane_of(id).projection, facets[id].orientation < 0});
  }
}

}  // namespace algebra3d
