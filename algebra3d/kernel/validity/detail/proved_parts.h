#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/detail/height_fields.h"
#include "algebra3d/kernel/validity/detail/vertex_stars.h"
#include "algebra3d/kernel/validity/face_set.h"

namespace algebra3d {

/// The parts of a proof that are known before pairs of faces are tested. Refers to `known`.
struct ProvedParts {
  /// `known_faces` as in ProofOptions.
  ProvedParts(const TriangleMesh& mesh, const FaceSet& known_faces)
      : fields(mesh), stars(mesh, fields, known_faces), known(known_faces) {}

  HeightFields fields;
  EmbeddedStars stars;
  const FaceSet& known;
};

}  // namespace algebra3d
