#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"

namespace algebra3d::arrangement {

/// A tree of the boxes of all faces of all operands, made when it is first asked for.
class FaceTree {
 public:
  explicit FaceTree(const Operands& operands) : operands_(operands) {}

  /// The tree. Cost of the first call: n log n in all faces.
  const IdTree<InputFaceId>& get();

 private:
  const Operands& operands_;
  std::optional<IdTree<InputFaceId>> tree_;
};

/// True if the cell above a point of a triangle lies in front of the triangle. Exact.
/// The cell above a point, also of one that lies on faces, is the cell in the direction (e, e^2, 1) from it, for an e >
/// 0 smaller than any number. No plane contains this direction, so there is one such cell. cross_vertical_line looks
/// along the same direction.
bool is_cell_above_in_front(const TriangleRef& triangle);

/// Upward ray shooting: the faces of all operands above a point, from the lowest one on. The ray has the direction of
/// the cell above (is_cell_above_in_front).
class FacesAbove {
 public:
  /// A face that the ray hits, and whether its normal points up (1) or down (-1). Returns whether to go on.
  using Visit = std::function<bool(InputFaceId face, int sign)>;

  FacesAbove(const Operands& operands, FaceTree& faces) : operands_(operands), faces_(faces) {}

  /// Calls visit for each face above the point, until it returns false. The point may lie on faces, which are not above
  /// it. False if two faces are hit at the same height, as where they cross or coincide straight above the point: the
  /// direction keeps the ray off their edges, but does not put them in order. Then visit was called for those below
  /// only. Exact. Cost: that of a column of boxes up to the last face visited; the first call makes the tree of all
  /// faces.
  bool for_each(const PointRef& point, const Visit& visit);

 private:
  struct Hit;

  std::vector<Hit> hits_in(const Box3& slab, bool is_lowest_slab, const PointRef& point);

  const Operands& operands_;
  FaceTree& faces_;
};

}  // namespace algebra3d::arrangement
