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

  /// Winding number of the operand about a point that lies on none of its faces. Exact. Cost: that of a vertical line
  /// through the hierarchy of its boxes.
  int winding(std::uint32_t operand, const PointRef& point) const;
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
