#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algebra3d/arrangement/operands.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {

/// Tells of single points in which operands they lie.
class PointLocation {
 public:
  explicit PointLocation(const Operands& operands) : operands_(operands) {}

  /// How many faces of the operand that look up are above the point, less those that look down: its winding number
  /// about the point, if it is closed and the point lies on none of its faces. Exact. Cost: that of a vertical line
  /// through the hierarchy of its boxes.
  int crossings_above(std::uint32_t operand, const PointRef& point) const;
  /// Operands whose boxes meet this one. Ascending.
  std::vector<std::uint32_t> operands_meeting(const Box3& box);
  /// Operands whose boxes hold the point; others do not hold it. Ascending.
  std::vector<std::uint32_t> near(const PointRef& point);
  /// True if there are more of them than so many. Cost: that of finding one more.
  bool is_near_many(const PointRef& point, std::size_t many);

 private:
  const rtree::RTree<std::uint32_t>& boxes();

  const Operands& operands_;
  std::unique_ptr<rtree::RTree<std::uint32_t>> boxes_;  // of the operands, once it was asked for
};

}  // namespace algebra3d::arrangement
