#include "algebra3d/arrangement/point_location.h"

#include <algorithm>

#include "algebra3d/exact/vertical_line.h"
#include "algebra3d/halfedge/boxes.h"

namespace algebra3d::arrangement {

int PointLocation::winding(std::uint32_t operand, const PointRef& point) const {
  int winding = 0;
  operands_.hierarchy(operand).for_each_on_vertical_ray(box_of(point), 1, [&](std::uint32_t face) {
    const LineCrossing crossing = cross_vertical_line(point, operands_.mesh(operand).corners(FaceId(face)));
    if (crossing.side == -1) winding += crossing.sign;
  });
  return winding;
}

std::vector<std::uint32_t> PointLocation::near(const PointRef& point) {
  if (!boxes_) {
    std::vector<rtree::Entry<std::uint32_t>> entries;
    for (std::uint32_t i = 0; i < operands_.count(); ++i) entries.push_back({operands_.hierarchy(i).bounds(), i});
    boxes_ = std::make_unique<rtree::RTree<std::uint32_t>>(rtree::RTree<std::uint32_t>::bulk_load(entries));
  }
  std::vector<std::uint32_t> result;
  for (const std::uint32_t operand : boxes_->window(box_of(point))) result.push_back(operand);
  std::ranges::sort(result);
  return result;
}

}  // namespace algebra3d::arrangement
