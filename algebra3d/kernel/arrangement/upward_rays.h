#pragma once

#include <functional>
#include <memory>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Upward ray shooting in one mesh: finds the faces above a point. Like detail/faces_above.h, with one mesh in place of
/// operands, for the cells of a repair (repair/detail/space_cells.h). Rays have the direction (e, e^2, 1), for an e > 0
/// smaller than any number. No plane contains it, so a ray that hits a face always passes through it, and there is one
/// cell above a point even if that lies on faces.
class UpwardRays {
 public:
  /// Called with a face that a ray hits, and whether its normal points up. Returns whether to continue.
  using Visit = std::function<bool(FaceId face, bool looks_up)>;

  /// The mesh must outlive this.
  explicit UpwardRays(const TriangleMesh& mesh);
  ~UpwardRays();
  UpwardRays(const UpwardRays&) = delete;
  UpwardRays& operator=(const UpwardRays&) = delete;

  /// Calls visit for each face above the point, from the lowest one on, until it returns false. Faces on which the
  /// point lies are not above it. False if two faces are hit at the same height, as where they cross or coincide
  /// straight above the point: the direction keeps the ray off their edges, but does not put them in order. Then visit
  /// was called for those below only. Exact. Cost: that of a column of boxes up to the last face visited; the first
  /// call makes a tree of all faces.
  bool for_each(const PointRef& point, const Visit& visit);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// True if the direction of upward rays leads from the plane of a triangle to its front. Exact.
bool leads_up_to_front(const TriangleRef& triangle);

}  // namespace algebra3d
