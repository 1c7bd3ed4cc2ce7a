#include "algebra3d/arrangement/point_location.h"

#include <algorithm>

#include "algebra3d/exact/vertical_line.h"
#include "algebra3d/halfedge/boxes.h"

namespace algebra3d::arrangement {

int PointLocation::crossings_above(std::uint32_t operand, const PointRef& point) const {
  int sum = 0;
  operands_.hierarchy(operand).for_each_on_vertical_ray(box_of(point), 1, [&](std::uint32_t face) {
    const LineCrossing crossing = cross_vertical_line(point, operands_.mesh(operand).corners(FaceId(face)));
    if (crossing.side == -1) sum += crossing.sign;
  });
  return sum;
}

const rtree::RTree<std::uint32_t>& PointLocation::boxes() {
  if (!boxes_) {
    std::vector<rtree::Entry<std::uint32_t>> entries;
    for (std::uint32_t i = 0; i < operands_.count(); ++i) entries.push_back({operands_.hierarchy(i).bounds(), i});
    boxes_ = std::make_unique<rtree::RTree<std::uint32_t>>(rtree::RTree<std::uint32_t>::bulk_load(entries));
  }
  return *boxes_;
}

std::vector<std::uint32_t> PointLocation::operands_meeting(const Box3& box) {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t operand : boxes().window(box)) result.push_back(operand);
  std::ranges::sort(result);
  return result;
}

std::vector<std::uint32_t> PointLocation::near(const PointRef& point) {
  return operands_meeting(box_of(point));
}

bool PointLocation::is_near_many(const PointRef& point, std::size_t many) {
  auto found = boxes().window(box_of(point));
  std::size_t count = 0;
  while (count <= many && found.next()) ++count;
  return count > many;
}

}  // namespace algebra3d::arrangement
