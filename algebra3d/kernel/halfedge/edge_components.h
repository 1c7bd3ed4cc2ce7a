#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// An edge-connected component of the faces of a mesh: a shell or an open patch. Numbered in order of the first faces.
using EdgeComponentId = StrongId<struct EdgeComponentKind>;

/// The edge-connected components of a mesh, in a form that is small where there is only one.
class EdgeComponents {
 public:
  EdgeComponents() = default;
  /// Cost: linear.
  explicit EdgeComponents(const TriangleMesh& mesh);

  std::size_t count() const { return first_faces_.size(); }
  EdgeComponentId of(FaceId face) const {
    return of_face_.empty() ? EdgeComponentId(0) : EdgeComponentId(of_face_[face.index()]);
  }
  /// The lowest face of a component.
  FaceId first_face(EdgeComponentId component) const { return first_faces_[component.index()]; }

 private:
  std::vector<FaceId> first_faces_;
  std::vector<std::uint32_t> of_face_;  // empty if there is one component at most
};

}  // namespace algebra3d
