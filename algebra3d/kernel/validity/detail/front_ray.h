#pragma once

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A vertical ray from an inner point of a face to where its front looks, which sums up the winding number there. It
/// needs all faces of closed meshes that it meets but the face itself, in any order; others do not matter.
class FrontRay {
 public:
  /// `face`: not vertical. `attempt`: at most 50; the points are all different, so that only finitely many can be
  /// points in which another face touches.
  FrontRay(const TriangleRef& face, int attempt);

  const ExactPoint& start() const { return start_; }
  /// 1 or -1: whether the ray goes up or down.
  int upward() const { return upward_; }
  void cross(const TriangleMesh& mesh, FaceId face);

  /// True if the ray starts on one of the faces that it crossed: the sum is worth nothing.
  bool starts_on_other() const { return starts_on_other_; }
  /// The winding number in front of the face at the start, from the faces that the ray crossed.
  int winding() const { return winding_; }

 private:
  ExactPoint start_;
  int upward_;
  int winding_ = 0;
  bool starts_on_other_ = false;
};

/// True if a face is vertical: it has no area seen from above. Exact.
bool is_vertical(const TriangleRef& face);

}  // namespace algebra3d
