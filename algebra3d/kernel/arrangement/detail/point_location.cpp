#include "algebra3d/kernel/arrangement/detail/point_location.h"

#include <algorithm>
#include <limits>

#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/search/boxes.h"

namespace algebra3d::arrangement {

int PointLocation::winding_number(OperandId operand, const PointRef& point) const {
  int sum = 0;
  operands_.hierarchy(operand).for_each_on_vertical_ray(box_of(point), 1, [&](std::uint32_t face) {
    const LineCrossing crossing = cross_vertical_line(point, operands_.mesh(operand).corners(FaceId(face)));
    if (crossing.side == -1) sum += crossing.sign;
  });
  return sum;
}

WindingVector PointLocation::windings_above(const PointRef& point) {
  Box3 above = box_of(point);
  above.max.z = std::numeric_limits<double>::max();
  WindingVector windings;
  for (const OperandId operand : operands_meeting(above))
    windings[operands_.group(operand)] += winding_number(operand, point);
  return windings;
}

const IdTree<OperandId>& PointLocation::boxes() {
  if (!boxes_) {
    IdTree<OperandId>::Boxes boxes;
    for (const OperandId i : operands_.ids()) boxes.add(operands_.hierarchy(i).bounds(), i);
    boxes_.emplace(boxes.tree());
  }
  return *boxes_;
}

std::vector<OperandId> PointLocation::operands_meeting(const Box3& box) {
  std::vector<OperandId> result;
  boxes().for_each_in(box, [&](OperandId operand) { result.push_back(operand); });
  std::ranges::sort(result);
  return result;
}

}  // namespace algebra3d::arrangement
