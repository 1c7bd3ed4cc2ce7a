#pragma once

#include <optional>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"

namespace algebra3d::arrangement {

/// Point-in-operand queries.
class PointLocation {
 public:
  explicit PointLocation(const Operands& operands) : operands_(operands) {}

  /// The winding number of a closed operand about the cell above the point (faces_above.h): the number of its faces
  /// above the point that look up, less those that look down. If the point is on no face of the operand, that is the
  /// winding number about the point. Exact. Cost: that of an upward ray through the hierarchy of its boxes.
  int winding_number(OperandId operand, const PointRef& point) const;
  /// Winding numbers about the cell above the point, of all operands. Exact. Cost: that of an upward ray through the
  /// hierarchies of all operands whose boxes it meets.
  WindingVector windings_above(const PointRef& point);
  /// Operands whose boxes hold the point; others do not hold it. Ascending.
  std::vector<OperandId> near(const PointRef& point) { return operands_meeting(box_of(point)); }
  /// True if the boxes of more operands than `count` hold the point. Cost: that of finding one more.
  bool has_more_near(const PointRef& point, std::size_t count) { return boxes().has_more_in(box_of(point), count); }

 private:
  const IdTree<OperandId>& boxes();
  std::vector<OperandId> operands_meeting(const Box3& box);

  const Operands& operands_;
  std::optional<IdTree<OperandId>> boxes_;  // of the operands, once it was asked for
};

}  // namespace algebra3d::arrangement
