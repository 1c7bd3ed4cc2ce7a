#include "algebra3d/kernel/halfedge/edge_components.h"

#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"

namespace algebra3d {

EdgeComponents::EdgeComponents(const TriangleMesh& mesh) {
  FaceComponents components = connected_components(mesh);
  first_faces_.reserve(components.count);
  // Components are numbered in the order of their first faces.
  for (const FaceId face : faces(mesh))
    if (components.of_face[face.index()] == first_faces_.size()) first_faces_.push_back(face);
  if (components.count > 1) of_face_ = std::move(components.of_face);
}

}  // namespace algebra3d
